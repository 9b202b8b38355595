#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "papers/literal_fit.h"
#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"

// The statements of docs/papers/noise-by-example.md, on an exemplar whose spectrum is known.
namespace solidnoise::papers {
namespace {

double band_a(int b) {
  return std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2)) * std::exp2(-b);
}

// One realisation of a sum of four Gaussians of three widths, 64 x 64 samples.
PowerSpectrum<2> periodogram() {
  GaborSpectrum spectrum;
  spectrum.bands = {{band_a(2), {{{0.10, 0.05, 0.0}, 1.0}}},
                    {band_a(3), {{{0.25, -0.20, 0.0}, 0.5}, {{0.05, 0.30, 0.0}, 0.3}}},
                    {band_a(4), {{{0.18, 0.18, 0.0}, 0.2}}}};
  Exemplar<2> exemplar;
  exemplar.channels.push_back(gaussian_field(sampled_density<2>(spectrum, {64, 64}, {1.0, 1.0}), 1));
  return cross_spectra<2>(std::span(&exemplar, 1)).spectrum(std::array{1.0});
}

TEST(NoiseByExample, Equation8TakenLiterallyUsesTheNarrowestBandAlone) {
  const BandCounts found = fit_bands(periodogram(), 1.0 / 64.0, Penalty::squared_magnitudes, 60);
  ASSERT_EQ(found.components.size(), 5u);
  for (std::size_t band = 0; band < 4; ++band) EXPECT_EQ(found.components[band], 0) << band;
  EXPECT_GT(found.components[4], 100);
}

TEST(NoiseByExample, AtomsOfUnitLengthUseTheBandsOfTheSpectrum) {
  const BandCounts found = fit_bands(periodogram(), 1.0 / 8.0, Penalty::lengths, 60);
  EXPECT_GT(found.components[0], 0);
  EXPECT_GT(found.components[1] + found.components[2], 0);
}

TEST(NoiseByExample, SmallerKappasAreNearerToThePeriodogramAndLessSparse) {
  const PowerSpectrum<2> target = periodogram();
  SpectrumFitOptions options = SpectrumFitOptions::of_paper();
  double residual = 1.0;
  int components = 0;
  for (const double kappa : {1.0 / 2.0, 1.0 / 8.0, 1.0 / 32.0, 1.0 / 256.0}) {
    options.kappa = kappa;
    const SpectrumFit fit = fit_spectrum(target, target.variance(), options);
    EXPECT_LT(fit.residual, residual) << kappa;
    EXPECT_GE(fit.components, components) << kappa;
    residual = fit.residual;
    components = fit.components;
  }
}

}  // namespace
}  // namespace solidnoise::papers
