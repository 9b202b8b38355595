#include <cmath>

#include <gtest/gtest.h>

#include "papers/gradient_sample.h"
#include "solidnoise/noise/gradient/gradient_kernel.h"

// The numbers of docs/papers/gradient-noise.md, by smaller runs of the code that makes the page: a full
// repetition of the tables, at half of its samples. Seeds are fixed.
namespace solidnoise::papers {
namespace {

constexpr GradientSampleSize kSize{.side = 512, .step = 0.5};

PowerSpectrum<2> spectrum_of(GradientKind kind) {
  return gradient_spectrum(kind, sample_gradient(kind, kSize));
}

// A line of 512 frequencies, half of which hold the power and are each other's opposites in part, scatters by
// some 1 / sqrt(2 * 128) = 0.06.
TEST(BetterGradientNoise, TheClassicHashLeavesStripesAndTheExclusiveOrNone) {
  const PowerSpectrum<2> classic = spectrum_of(GradientKind::chained);
  EXPECT_GT(striation(classic, 0), 0.3);
  EXPECT_LT(striation(classic, 1), 0.1);
  const PowerSpectrum<2> exclusive_or = spectrum_of(GradientKind::xor_tables);
  EXPECT_LT(striation(exclusive_or, 0), 0.1);
  EXPECT_LT(striation(exclusive_or, 1), 0.1);
}

// The variance of 65536 gradients' noise has a standard error of about 0.5 %.
TEST(BetterGradientNoise, TheWideKernelHasTheClosedFormsVarianceAndPeak) {
  const PowerSpectrum<2> wide = spectrum_of(GradientKind::wide);
  EXPECT_NEAR(wide.variance(), 1.0, 0.03);
  const GradientKernel<2> kernel(GradientNoiseOptions::Kernel::kensler);
  EXPECT_NEAR(band_limit(wide).peak, kernel.spectrum_peak(), 0.06) << "bins are 0.05 wide";
}

// Power below a quarter of the peak, by quadrature of the closed forms 0.0014 and 4.2e-5 in two dimensions.
// A plane through three dimensions has two orders of magnitude more, and projection takes it away again.
TEST(BetterGradientNoise, ProjectionEmptiesTheMiddleOfASlicesSpectrum) {
  const double wide = band_limit(spectrum_of(GradientKind::wide)).low_share;
  const double slice = band_limit(spectrum_of(GradientKind::slice)).low_share;
  const double projected = band_limit(spectrum_of(GradientKind::projected)).low_share;
  EXPECT_NEAR(wide, 0.0014, 0.0005);
  EXPECT_GT(slice, 0.02);
  EXPECT_NEAR(projected, 0.0014, 0.0005);
  EXPECT_LT(band_limit(spectrum_of(GradientKind::wide_zero_dc)).low_share, 1e-4);
}

// Means of the closed form over positions are 0.0125 in a layer and half-way between the layers 0, or, with
// the wider window, a half of it; 40000 correlated samples have some 4000 independent ones, 4 % in all.
TEST(BetterGradientNoise, HalfResolutionAsPrintedVanishesBetweenTheLayers) {
  EXPECT_EQ(plane_variance(2, 1.0, 1.0, 64, 1), 0.0);
  EXPECT_GT(plane_variance(2, 0.0, 1.0, 64, 1), 0.01);
  const double in_layer = plane_variance(2, 0.0, 2.0, 200, 1);
  const double between = plane_variance(2, 1.0, 2.0, 200, 1);
  EXPECT_NEAR(in_layer, 0.0127, 0.0015);
  EXPECT_NEAR(between / in_layer, 0.5, 0.1);
}

}  // namespace
}  // namespace solidnoise::papers
