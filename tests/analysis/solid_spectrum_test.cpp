#include "solidnoise/analysis/exemplar/solid_spectrum.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise::solid_spectrum_test {
namespace {

double band_a(int b) {
  return std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2)) * std::exp2(-b);
}

// A power spectrum that depends on |f| alone.
template <typename Density>
PowerSpectrum<2> radial(const Density& density) {
  PowerSpectrum<2> spectrum;
  spectrum.count = glm::ivec2(128);
  spectrum.density.resize(128 * 128);
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    spectrum.density[i] = density(glm::length(spectrum.frequency(i)));
  }
  return spectrum;
}

// The slice of a 3D density is its integral across: against GaborSpectrum::density, by the midpoint rule with
// steps of a / 50, whose error for Gaussians is far below 1e-9.
TEST(SliceDensity, IsTheIntegralAcross) {
  for (const double frequency : {0.0, 0.05, 0.3}) {
    for (const int b : {2, 4}) {
      GaborSpectrum solid;
      solid.dimensions = 3;
      solid.isotropic = true;
      solid.bands = {{band_a(b), {{Vec<3>(frequency, 0.0, 0.0), 1.0}}}};
      for (const double f : {0.0, 0.1, 0.32}) {
        double sum = 0.0;
        const double step = band_a(b) / 50.0;
        for (int i = -3000; i < 3000; ++i) sum += solid.density(Vec<3>(f, 0.0, (i + 0.5) * step)) * step;
        EXPECT_NEAR(slice_density(f, frequency, band_a(b)), sum, 1e-9 * (1.0 + sum));
      }
    }
  }
}

// A mixture of two slices of the dictionary is found again.
TEST(SolidSpectrum, RecoversSlicesOfSolidNoise) {
  const PowerSpectrum<2> slices = radial([](double f) {
    return slice_density(f, 4.0 * 0.5 / 16.0, band_a(4)) + 0.6 * slice_density(f, 0.25, band_a(3));
  });
  const SolidFit fit = fit_solid_spectrum(slices, 1.6, 1.0 / 64.0);
  // Radial means mix frequencies that differ by up to half a step: 1e-3 of the spectrum.
  EXPECT_LT(fit.attainability, 5e-3);
  EXPECT_LT(fit.residual, 0.05);
  EXPECT_LE(fit.components, 8);
  EXPECT_NEAR(fit.spectrum.variance(), 1.6, 1e-9);
  EXPECT_TRUE(fit.spectrum.isotropic);
  EXPECT_EQ(fit.spectrum.dimensions, 3);
  EXPECT_NO_THROW(fit.spectrum.validate());
  EXPECT_TRUE(fit.warnings.empty());
}

// Any spectrum that does not rise can be had, none with a band alone: 0.40 is what the least squares leave of
// a ring of 24 +- 4 frequencies (found independently).
TEST(SolidSpectrum, KnowsWhatNoSolidNoiseCanShow) {
  const PowerSpectrum<2> low = radial([](double f) { return std::exp(-f * f / 0.02); });
  EXPECT_LT(fit_solid_spectrum(low, 1.0).attainability, 5e-3);
  const PowerSpectrum<2> ring =
      radial([](double f) { return std::exp(-0.5 * std::pow((128 * f - 24.0) / 4.0, 2)); });
  const SolidFit fit = fit_solid_spectrum(ring, 1.0);
  EXPECT_NEAR(fit.attainability, 0.40, 0.05);
  EXPECT_EQ(fit.warnings.size(), 1u);
}

TEST(SolidSpectrum, WarnsOfDirections) {
  GaborSpectrum oriented;
  oriented.bands = {{band_a(3), {{{0.1, 0.0, 0.0}, 1.0}}}, {band_a(2), {{{0.0, 0.0, 0.0}, 0.2}}}};
  const PowerSpectrum<2> density = sampled_density<2>(oriented, glm::ivec2(128), Vec<2>(1.0));
  const Exemplar<2> exemplar{{gaussian_field(density, 1)}};
  const SolidExemplarFit fit = fit_solid_exemplar(std::vector{exemplar});
  EXPECT_GT(fit.channels[0].anisotropy, 0.5);
  EXPECT_FALSE(fit.channels[0].warnings.empty());
}

// One realisation of an isotropic texture: whatever its scatter, no warning.
TEST(SolidSpectrum, DoesNotWarnOfScatter) {
  const PowerSpectrum<2> low = radial([](double f) { return std::exp(-f * f / 0.01); });
  const Exemplar<2> exemplar{{gaussian_field(low, 3)}};
  const SolidExemplarFit fit = fit_solid_exemplar(std::vector{exemplar});
  EXPECT_EQ(fit.channels[0].anisotropy, 0.0);
  EXPECT_TRUE(fit.channels[0].warnings.empty());
  EXPECT_EQ(fit.model.channels.size(), 1u);
}

}  // namespace
}  // namespace solidnoise::solid_spectrum_test
