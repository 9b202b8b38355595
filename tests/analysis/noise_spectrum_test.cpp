#include <memory>

#include <gtest/gtest.h>

#include "solidnoise/analysis/expected_spectrum.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/welch_spectrum.h"

namespace solidnoise::noise_spectrum_test {
namespace {

constexpr double kStep = 1.0 / 40.0;  // 5 samples per cycle of the principal frequency

template <int Dim>
SpectrumComparison compare_noise(const Noise<Dim>& noise, int size, int block,
                                 const ComparisonOptions& options) {
  Lattice<Dim> lattice;
  lattice.origin = Vec<Dim>(0.123);
  lattice.step = Vec<Dim>(kStep);
  lattice.count = glm::vec<Dim, int>(size);
  DenseField<Dim> field(lattice.count, lattice.step);
  noise.evaluate(lattice, Samples<Dim>{field.values, {}});
  const glm::vec<Dim, int> block_count(block);
  return compare_spectra(welch_spectrum(field, block_count),
                         expected_periodogram(noise, block_count, lattice.step), options);
}

// Each test is one draw from the fixed seeds: 1e-4 is the rate at which a right noise would be refused.
constexpr double kSignificance = 1e-4;

TEST(NoiseSpectrum, OfIsotropicGaborNoiseIsItsClosedFormInThePlane) {
  const GaborNoise<2> noise(GaborNoiseOptions{.frequency = 8.0, .seed = 3});
  const SpectrumComparison comparison =
      compare_noise<2>(noise, 768, 128, {.impulse_density = noise.impulse_density()});
  EXPECT_GE(comparison.degrees_of_freedom, 15);
  EXPECT_GT(comparison.significance, kSignificance);
}

TEST(NoiseSpectrum, OfIsotropicGaborNoiseIsItsClosedFormInSpace) {
  const GaborNoise<3> noise(GaborNoiseOptions{.frequency = 8.0, .seed = 3});
  const SpectrumComparison comparison =
      compare_noise<3>(noise, 112, 56, {.impulse_density = noise.impulse_density()});
  EXPECT_GE(comparison.degrees_of_freedom, 8);
  EXPECT_GT(comparison.significance, kSignificance);
}

TEST(NoiseSpectrum, OfOrientedGaborNoiseIsItsClosedFormUpToTheKernelsError) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 8.0, .error = 0.02};
  const SpectrumComparison comparison =
      compare_noise<3>(*make_noise<3>(recipe), 112, 56, {.kernel_error = 0.02});
  EXPECT_GE(comparison.degrees_of_freedom, 6);
  EXPECT_GT(comparison.significance, kSignificance);
}

TEST(NoiseSpectrum, OfGradientNoiseIsItsClosedForm) {
  NoiseRecipe recipe;
  recipe.noise = GradientNoiseOptions{.frequency = 8.0};
  const SpectrumComparison comparison = compare_noise<3>(*make_noise<3>(recipe), 128, 64, {});
  EXPECT_GE(comparison.degrees_of_freedom, 8);
  EXPECT_GT(comparison.significance, kSignificance);
}

TEST(NoiseSpectrum, OfAnotherFrequencyIsRecognised) {
  const GaborNoise<2> noise(GaborNoiseOptions{.frequency = 8.0, .seed = 3});
  const GaborNoise<2> other(GaborNoiseOptions{.frequency = 8.4});
  Lattice<2> lattice;
  lattice.step = Vec<2>(kStep);
  lattice.count = glm::ivec2(512);
  DenseField<2> field(lattice.count, lattice.step);
  noise.evaluate(lattice, Samples<2>{field.values, {}});

  const SpectrumComparison comparison = compare_spectra(
      welch_spectrum(field, {128, 128}), expected_periodogram<2>(other, {128, 128}, lattice.step),
      {.impulse_density = noise.impulse_density()});

  EXPECT_LT(comparison.significance, 1e-12);
}

}  // namespace
}  // namespace solidnoise::noise_spectrum_test
