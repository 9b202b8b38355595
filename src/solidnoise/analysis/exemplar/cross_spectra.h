#pragma once

#include <complex>
#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Means and covariances of all samples of exemplars.
struct SampleMoments {
  std::vector<double> mean;        // per channel
  std::vector<double> covariance;  // channels x channels
};
template <int Dim>
SampleMoments sample_moments(std::span<const Exemplar<Dim>> exemplars);

// The cross-periodograms of an exemplar's channels, averaged over patches: at each frequency f the matrix
//   C_ij(f) = conj(U_i(f)) U_j(f) / n,   U the transform of channel i's periodic component,
// n the number of samples of a patch. They are the Fourier transforms of the lagged correlation matrices
// (Galerne et al. 2012, eq. 9, with 1/n where the paper prints 1/M^2 for a square image).
template <int Dim>
struct CrossSpectra : SampleMoments {
  glm::vec<Dim, int> count{1};  // of a patch
  Vec<Dim> step{1.0};           // world units
  int channels = 1;
  int patches = 0;
  std::vector<std::vector<std::complex<double>>> cross;  // channels x channels; frequencies as PowerSpectrum

  // The sum of the cross-spectra's real parts by their weights, channels x channels.
  PowerSpectrum<Dim> weighted(std::span<const double> weights) const;
  // Of the channel that is the product of the given direction and the color.
  PowerSpectrum<Dim> spectrum(std::span<const double> direction) const;
  double variance(std::span<const double> direction) const;
};

// Spectra of one or several exemplars with the same step and channels, cut into patches of one size: at most
// `patch` samples along each axis (0: as large as the smallest exemplar, but of pictures 256 where that is
// above 384, which holds what is texture in them, and many patches scatter less), cut down to a fast_count;
// patches of an exemplar that is larger overlap by half at most. Patches keep their own periodic components;
// the mean of all samples, in patches or not, is taken away. Throws std::invalid_argument for exemplars that
// do not agree, Cancelled.
template <int Dim>
CrossSpectra<Dim> cross_spectra(std::span<const Exemplar<Dim>> exemplars, int patch = 0,
                                Progress* progress = nullptr);

}  // namespace solidnoise
