#pragma once

#include "solidnoise/analysis/exemplar/sparse_fit.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

struct SpectrumFitOptions {
  double kappa = 1.0 / 256.0;  // sparseness against accuracy; above 0, at most 1
  // Whether there are Gaussians as narrow as one frequency of the exemplar, for textures with periodic parts.
  // Stochastic ones are better off without: such Gaussians follow the periodogram's own noise.
  bool narrowest_band = false;
  // Whether faint, fine detail, which the sparse fit leaves out, is added by fill_spectrum(), in 2D.
  bool fill = true;
  double gap_tolerance = 1e-2;
  int iterations_per_level = 600;

  // The parameters of Galerne et al. 2012: kappa = 1/256, all bands, nothing added.
  static SpectrumFitOptions of_paper();

  // Throws std::invalid_argument.
  void validate() const;
};

struct SpectrumFit {
  GaborSpectrum spectrum;
  int components = 0;
  double sparseness = 0.0;     // components / samples
  double residual = 0.0;       // |spectrum - periodogram| / |periodogram|
  double kept_variance = 0.0;  // of the components before they were rescaled, relative to the samples'
  double kappa = 1.0;          // reached
  double gap = 0.0;            // duality gap / objective
  int iterations = 0;
  bool interrupted = false;
};

// The parameters of a bandwidth-quantized Gabor noise from a periodogram (Galerne et al. 2012, section 5):
// bands b = 2, 3, ... whose Gaussians have a full width at half maximum of 2^-b cycles per sample,
// a = 2^-b sqrt(pi / (2 ln 2)), down to two frequencies of the shortest axis (one with narrowest_band);
// frequencies at about half of that width, in a half-plane (half-space). The penalty makes variances too
// small; they are scaled to those of the periodogram, and the lowest such that all sum to `variance`. (Least
// squares among the components that were found follow the periodogram's own noise instead, and are further
// from the true spectrum.)
//
// Departures: Gaussians of unit length (GaussianAtoms), frequencies no denser than they can be told apart,
// the default range of bands. They lower the error against the true
// spectrum; a larger kappa lowers it further for textures of a few broad peaks, but those with a steep
// spectrum, as most natural ones, need a small one for their faint, fine detail.
template <int Dim>
SpectrumFit fit_spectrum(const PowerSpectrum<Dim>& periodogram, double variance,
                         const SpectrumFitOptions& options = {}, Progress* progress = nullptr);

}  // namespace solidnoise
