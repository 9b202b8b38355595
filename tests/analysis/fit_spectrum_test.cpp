#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise::fit_spectrum_test {
namespace {

double band_a(int b) {
  return std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2)) * std::exp2(-b);
}

// Four pairs of Gaussians in three bands.
GaborSpectrum mixture() {
  GaborSpectrum spectrum;
  spectrum.bands = {{band_a(3), {{{0.10, 0.05, 0.0}, 1.0}}},
                    {band_a(4), {{{0.25, -0.20, 0.0}, 0.5}, {{0.05, 0.30, 0.0}, 0.3}}},
                    {band_a(5), {{{0.18, 0.18, 0.0}, 0.2}}}};
  return spectrum;
}

template <int Dim>
double error_against(const GaborSpectrum& fit, const PowerSpectrum<Dim>& truth) {
  const PowerSpectrum<Dim> found = sampled_density<Dim>(fit, truth.count, truth.step);
  double off = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < found.density.size(); ++i) {
    off += (found.density[i] - truth.density[i]) * (found.density[i] - truth.density[i]);
    all += truth.density[i] * truth.density[i];
  }
  return std::sqrt(off / all);
}

std::vector<Exemplar<2>> realisations(const PowerSpectrum<2>& truth, int count) {
  std::vector<Exemplar<2>> result(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    result[static_cast<std::size_t>(i)].channels.push_back(
        gaussian_field(truth, static_cast<std::uint64_t>(i)));
  }
  return result;
}

SpectrumFit fit_realisations(const PowerSpectrum<2>& truth, int exemplars,
                             const SpectrumFitOptions& options = {}) {
  const CrossSpectra<2> spectra = cross_spectra<2>(realisations(truth, exemplars));
  return fit_spectrum(spectra.spectrum(std::array{1.0}), spectra.variance(std::array{1.0}), options);
}

// The periodogram of one realisation is off by its own scatter, which is as large as the spectrum; its
// smallest possible error is 0.74 here. The bounds are the errors found with one set of seeds, 0.47 and 0.11,
// and a third more.
TEST(FitSpectrum, ComesCloserToTheTrueSpectrumThanThePeriodogram) {
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(128), Vec<2>(1.0));
  SpectrumFitOptions options;
  options.kappa = 1.0 / 16.0;
  const SpectrumFit one = fit_realisations(truth, 1, options);
  EXPECT_LT(error_against(one.spectrum, truth), 0.62);
  EXPECT_LT(one.components, 150);
  const SpectrumFit many = fit_realisations(truth, 16, options);
  EXPECT_LT(error_against(many.spectrum, truth), 0.15);
  EXPECT_LT(many.components, 60);
  EXPECT_NEAR(many.kept_variance, 1.0, 0.1);
}

// Without scatter the fit is left with what the penalty takes and the finite set of frequencies.
TEST(FitSpectrum, RecoversAnExactSpectrum) {
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(128), Vec<2>(1.0));
  SpectrumFitOptions options;
  options.kappa = 1.0 / 256.0;
  options.gap_tolerance = 1e-3;
  const SpectrumFit fit = fit_spectrum(truth, truth.variance(), options);
  EXPECT_LT(error_against(fit.spectrum, truth), 0.05);  // 0.031 found
  EXPECT_NEAR(fit.spectrum.variance(), truth.variance(), 1e-9);
  EXPECT_NO_THROW(fit.spectrum.validate());
}

// Following the scatter with the narrowest Gaussians is worse: what the defaults are for.
TEST(FitSpectrum, DefaultsAreCloserThanThePapersParameters) {
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(128), Vec<2>(1.0));
  const SpectrumFit paper = fit_realisations(truth, 1, SpectrumFitOptions::of_paper());
  const SpectrumFit ours = fit_realisations(truth, 1);
  EXPECT_LT(error_against(ours.spectrum, truth), 0.7 * error_against(paper.spectrum, truth));
  EXPECT_LT(paper.residual, 0.2);  // which follows the periodogram itself
  EXPECT_GT(2 * paper.components, 3 * ours.components);
}

// World units: the same exemplar with other pixels has frequencies and widths in proportion.
TEST(FitSpectrum, ScalesWithThePixels) {
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(64, 48), Vec<2>(1.0));
  PowerSpectrum<2> scaled = truth;
  scaled.step = Vec<2>(0.25);
  for (double& density : scaled.density) density /= 16.0;
  const SpectrumFit fit = fit_spectrum(truth, 2.0);
  const SpectrumFit fit_scaled = fit_spectrum(scaled, 2.0);
  ASSERT_EQ(fit.components, fit_scaled.components);
  for (std::size_t b = 0; b < fit.spectrum.bands.size(); ++b) {
    EXPECT_NEAR(fit_scaled.spectrum.bands[b].a, 4.0 * fit.spectrum.bands[b].a, 1e-9);
    for (std::size_t i = 0; i < fit.spectrum.bands[b].components.size(); ++i) {
      const SpectrumComponent& expected = fit.spectrum.bands[b].components[i];
      const SpectrumComponent& found = fit_scaled.spectrum.bands[b].components[i];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.frequency[axis], 4.0 * expected.frequency[axis], 1e-12);
      }
      EXPECT_NEAR(found.variance, expected.variance, 1e-6);
    }
  }
}

TEST(FitSpectrum, WorksInThreeDimensions) {
  GaborSpectrum two;
  two.dimensions = 3;
  two.bands = {{band_a(2), {{{0.1, 0.0, 0.2}, 1.0}}}, {band_a(3), {{{-0.1, 0.25, 0.1}, 0.7}}}};
  const PowerSpectrum<3> truth = sampled_density<3>(two, glm::ivec3(32, 30, 24), Vec<3>(1.0));
  Exemplar<3> exemplar;
  exemplar.channels.push_back(gaussian_field(truth, 5));
  const CrossSpectra<3> spectra = cross_spectra<3>(std::vector{exemplar});
  SpectrumFitOptions options;
  options.kappa = 1.0 / 8.0;
  const SpectrumFit fit = fit_spectrum(spectra.spectrum(std::array{1.0}), 1.7, options);
  EXPECT_EQ(fit.spectrum.dimensions, 3);
  EXPECT_NO_THROW(fit.spectrum.validate());
  // 0.27 with this seed; the periodogram is 0.9 off.
  EXPECT_LT(error_against(fit.spectrum, truth), 0.4);
}

TEST(GaussianField, HasItsSpectrum) {
  // The mean of 64 periodograms: in each of the 16 x 10 blocks of frequencies the mean of some 70 independent
  // values that scatter by 1/8 of their own size, and a hundredth of the total on average; 5 deviations.
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(96, 80), Vec<2>(1.0));
  EXPECT_NEAR(truth.variance(), 2.0, 1e-6);
  double variance = 0.0;
  for (const Exemplar<2>& exemplar : realisations(truth, 64)) {
    for (const float value : exemplar.channels[0].values) variance += value * value / (64.0 * 96.0 * 80.0);
  }
  // Relative deviation sqrt(sum of 2 S^2 / 64) / sum S, below 1 % here.
  EXPECT_NEAR(variance, 2.0, 0.1);
  const CrossSpectra<2> spectra = cross_spectra<2>(realisations(truth, 64));
  const PowerSpectrum<2> found = spectra.spectrum(std::array{1.0});
  double off = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < found.density.size(); ++i) {
    off += std::pow(found.density[i] - truth.density[i], 2);
    all += std::pow(truth.density[i], 2);
  }
  // Each bin scatters by 1/8 of itself: the error is 0.125, within 10 % as some 1000 bins take part.
  EXPECT_NEAR(std::sqrt(off / all), 0.125, 0.02);
}

TEST(GaussianVersion, KeepsTheSpectrumAndTheMean) {
  const PowerSpectrum<2> truth = sampled_density<2>(mixture(), glm::ivec2(64), Vec<2>(1.0));
  Exemplar<2> exemplar = realisations(truth, 1)[0];
  for (float& value : exemplar.channels[0].values) value = std::exp(value);
  const Exemplar<2> gaussian = gaussian_version(exemplar, 3);
  const CrossSpectra<2> before = cross_spectra<2>(std::vector{exemplar});
  const CrossSpectra<2> after = cross_spectra<2>(std::vector{gaussian});
  EXPECT_NEAR(after.mean[0], before.mean[0], 1e-5);
  // The version is periodic: its own periodic component differs by what the border's jumps are, so compare
  // with its plain periodogram by variance alone.
  double sum = 0.0;
  for (const float value : gaussian.channels[0].values) sum += std::pow(value - after.mean[0], 2) / 4096.0;
  EXPECT_NEAR(sum, before.spectrum(std::array{1.0}).variance(), 1e-3 * sum);
}

}  // namespace
}  // namespace solidnoise::fit_spectrum_test
