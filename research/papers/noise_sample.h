#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/noise/gabor/gabor_options.h"

namespace solidnoise::papers {

// How much of a noise is measured: pictures of `side` samples a side, one unit apart, of `seeds` seeds.
struct SampleSize {
  int side = 256;
  int seeds = 16;
  int bins = 80;  // of the histogram, from -5 to 5 standard deviations
};

// What is measured of isotropic Gabor noise of Dim dimensions on a plane (a line where Dim is 1), and what
// the closed forms say.
struct NoiseSample {
  DenseField<2> picture;  // of the first seed; of a line one row
  Moments moments;
  double variance_error = 0.0;   // standard error of the variance, from the scatter of the seeds
  double excess_kurtosis = 0.0;  // expected
  double impulses = 0.0;         // mean, under one kernel
  // Of each bin: its middle, the measured and the Gaussian's density.
  std::vector<double> value;
  std::vector<double> density;
  std::vector<double> gaussian;

  PowerSpectrum<2> estimated;  // of the plane
  PowerSpectrum<2> expected;
  SpectrumComparison radial;  // of the plane, or the line
};

// Lagae et al. 2011, figures 3, 4 and 5, and the same for 4 dimensions, which the paper leaves out. A plane
// through a noise of 3 or 4 dimensions has the spectrum of the kernel integrated over the frequencies that
// the plane does not see (IsotropicGaborKernel::slice_spectrum), which is what is expected here. Dim is 1 to
// 4.
template <int Dim>
NoiseSample sample_noise(const GaborNoiseOptions& options, const SampleSize& size);

// The spectrum in the three dimensions of a block of noise of 3 dimensions, or of frames of one of 4, against
// the closed form. Dim is 3 or 4.
template <int Dim>
SpectrumComparison sample_block_spectrum(const GaborNoiseOptions& options, const SampleSize& size);

}  // namespace solidnoise::papers
