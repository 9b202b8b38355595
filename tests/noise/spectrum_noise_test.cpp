#include "solidnoise/noise/gabor/spectrum_noise.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/spectra.h"
#include "support/tile_spectrum.h"

namespace solidnoise::spectrum_noise_test {
namespace {

template <typename Check>
void for_two_and_three_dimensions(const Check& check) {
  for (const bool isotropic : {false, true}) {
    SCOPED_TRACE(isotropic ? "isotropic" : "anisotropic");
    check.template operator()<2>(some_spectrum(2, isotropic));
    check.template operator()<3>(some_spectrum(3, isotropic));
  }
}

// Around each component, up to where little of it is left, and around the frequency 0.
TEST(SpectrumNoise, HasTheSpectrumOfItsComponentsPerBin) {
  for_two_and_three_dimensions([]<int Dim>(SpectrumNoiseOptions options) {
    constexpr double kPeriod = Dim == 2 ? 16.0 : 15.0;
    constexpr int kSide = Dim == 2 ? 96 : 60;
    options.period = Vec<4>(kPeriod);
    options.error = 0.002;  // the closed form is that of unlimited kernels
    const GaborSpectrum spectrum = options.spectrum();
    const SpectrumNoise<Dim> noise(options);
    std::vector<Vec<Dim>> centres;
    for (const SpectrumBand& band : spectrum.bands) {
      for (const SpectrumComponent& component : band.components)
        centres.push_back(Vec<Dim>(component.frequency));
    }
    const auto bin_of = [&](const WaveNumber<Dim>& k) {
      const Vec<Dim> f = Vec<Dim>(k) / kPeriod;
      if (spectrum.isotropic) return glm::length(f) > 1.6 ? -1 : static_cast<int>(glm::length(f) / 0.4);
      for (std::size_t i = 0; i < centres.size(); ++i) {
        if (std::fmin(glm::length(f - centres[i]), glm::length(f + centres[i])) < 0.3)
          return static_cast<int>(i);
      }
      return -1;
    };
    TileSpectrum<Dim> tiles(kSide, kPeriod);
    tiles.set_bins(4, bin_of, [&](const Vec<Dim>& f) { return noise.power_spectrum(f); });
    for (std::uint64_t seed = 0; seed < (Dim == 2 ? 100 : 6); ++seed) {
      options.seed = seed;
      tiles.add(SpectrumNoise<Dim>(options));
    }
    // Impulses of a component of the share s matter to its own bin most: E[p^2] / E[p]^2 is 1 / s at most.
    // All kernels have the same amplitude, so that the kernels' supports, as large as 1 / a^n each, hold N.
    const double impulses = options.impulses * std::pow(kPeriod * 0.4 / 1.5, Dim) / 4.0;
    tiles.expect_closed_form(impulses, 1.0 / 0.15, 0.02);
  });
}

TEST(SpectrumNoise, HasUnitVarianceAndItsKurtosis) {
  for_two_and_three_dimensions([]<int Dim>(const SpectrumNoiseOptions& options) {
    const SpectrumNoise<Dim> noise(options);
    EXPECT_NEAR(noise.spectrum().variance(), 1.0, 1e-12);
    const auto values = values_of<Dim>(noise, independent_lattice<Dim>(support_of(options)));
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                          3.0 + noise.excess_kurtosis());
  });
}

TEST(SpectrumNoise, ByDefaultHasTheKurtosisThatTheEyeTakesForGaussian) {
  for_two_and_three_dimensions([]<int Dim>(SpectrumNoiseOptions options) {
    options.impulses = 0.0;
    EXPECT_LE(std::abs(SpectrumNoise<Dim>(options).excess_kurtosis()), 1.0 / 64.0);
    EXPECT_LE(SpectrumNoise<Dim>(options).kurtosis_given_place(), 1.1 / 70.0);  // whole impulses in cubes
    options.impulses_process = ImpulseSpread::poisson;
    const SpectrumNoise<Dim> noise(options);
    EXPECT_LE(noise.excess_kurtosis(), 1.01 / 64.0);  // compact kernels: within a percent
    EXPECT_GT(noise.excess_kurtosis(), 0.9 / 64.0);
  });
}

// A band of a thousandth of the variance, of long waves: with the amplitude of all other kernels it would
// have one impulse in fifty of its supports.
// Of one component it is a noise of waves in one direction; of two bands of the same kernels and of shares p
// and 1 - p of the variance and of the impulses, each has a share of its square, and 1 / p times the
// kurtosis.
TEST(SpectrumNoise, HasTheKurtosisGivenThePlaceOfItsWaves) {
  OrientedGaborNoiseOptions waves{.frequency = 1.0, .impulses = 40.0};
  waves.anisotropy = 1.0;
  const OrientedGaborNoise<2> one(waves);
  GaborSpectrum spectrum;
  spectrum.dimensions = 2;
  spectrum.bands = {{one.kernel().a(), {{{1.0, 0.0, 0.0}, 1.0}}}};
  SpectrumNoiseOptions options;
  options.model.channels = {spectrum};
  options.frequency = 1.0;
  options.impulses = 40.0;
  EXPECT_NEAR(SpectrumNoise<2>(options).kurtosis_given_place() / one.kurtosis_given_place(), 1.0, 0.02);
  spectrum.bands = {{one.kernel().a(), {{{1.0, 0.0, 0.0}, 0.3}}},
                    {one.kernel().a(), {{{0.0, 1.0, 0.0}, 0.7}}}};
  options.model.channels = {spectrum};
  EXPECT_NEAR(SpectrumNoise<2>(options).kurtosis_given_place() / one.kurtosis_given_place(), 1.0, 0.2);
  options.impulses_process = ImpulseSpread::poisson;
  EXPECT_EQ(SpectrumNoise<2>(options).kurtosis_given_place(), 0.0);
}

TEST(SpectrumNoise, WeakBandsHaveImpulsesEnough) {
  SpectrumNoiseOptions options = some_spectrum(2);
  options.model.channels[0].bands.push_back({0.02, {{{0.5, 0.5, 0.0}, 1e-3}}});
  options.frequency = options.model.principal_frequency();
  const SpectrumNoise<2> noise(options);
  // A support has the area of a circle of about a radius of 1 / a.
  EXPECT_GT(noise.least_impulse_density() * std::numbers::pi / (0.02 * 0.02), 2.0);
  const auto values = values_of<2>(noise, independent_lattice<2>(support_of(options)));
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
}

TEST(SpectrumNoise, HasTheGradientVarianceOfItsSpectrum) {
  for_two_and_three_dimensions([]<int Dim>(const SpectrumNoiseOptions& options) {
    const SpectrumNoise<Dim> noise(options);
    const Lattice<Dim> lattice = independent_lattice<Dim>(support_of(options));
    Evaluated<Dim> evaluated(lattice.size());
    noise.evaluate(lattice, evaluated.samples());
    for (int axis = 0; axis < Dim; ++axis) {
      const auto& derivative = evaluated.gradient[static_cast<std::size_t>(axis)];
      expect_within_4_sigma(estimate_mean(derivative, [](double x) { return x * x; }),
                            noise.gradient_variance()[axis]);
    }
  });
}

TEST(SpectrumNoise, ScalesWithTheFrequency) {
  SpectrumNoiseOptions options = some_spectrum(2);
  const SpectrumNoise<2> unit(options);
  options.frequency *= 4.0;
  const SpectrumNoise<2> fine(options);
  Lattice<2> lattice;
  lattice.step = Vec<2>(0.25);
  lattice.count = {20, 30};
  const auto expected = values_of<2>(unit, lattice);
  lattice.step = Vec<2>(0.0625);
  const auto values = values_of<2>(fine, lattice);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], 1e-4) << i;
}

TEST(SpectrumNoise, RefusesWhatIsNoSpectrum) {
  const auto message = [](auto change) {
    SpectrumNoiseOptions options = some_spectrum(2);
    change(options);
    return message_of<std::invalid_argument>([&] { SpectrumNoise<2>{options}; });
  };
  EXPECT_EQ(message([](auto& o) { o.model.channels[0].bands[1].components[0].variance = -1.0; }),
            "channels[0]: bands[1].components[0].variance is -1; it must be 0 or more, and finite");
  EXPECT_EQ(message([](auto& o) { o.model.channels[0].bands[0].a = 0.0; }),
            "channels[0]: bands[0].a is 0; it must be between 1e-16 and 1e+16 (cycles per world unit)");
  EXPECT_EQ(message([](auto& o) { o.model.channels[0].bands[0].components[0].group = 1; }),
            "channels[0]: bands[0].components[0].group is 1; it must be the number of a group, from 0");
  EXPECT_EQ(
      message([](auto& o) { o.model.channels[0].bands.clear(); }),
      "channels[0]: the variances of all components add up to 0; the sum must be between 1e-60 and 1e+60");
  EXPECT_EQ(message([](auto& o) { o.model.channels.clear(); }),
            "exemplar is missing; it must be the model of an exemplar");
  EXPECT_EQ(message([](auto& o) { o.model.axes.clear(); }),
            "there are 0 axes for 1 channels; each needs one");
  EXPECT_EQ(message([](auto& o) { o.channel = 1; }).substr(0, 12), "channel is 1");
  EXPECT_EQ(message([](auto& o) { o.frequency = 0.0; }).substr(0, 14), "frequency is 0");
  EXPECT_EQ(message([](auto& o) { o.period = Vec<4>(1.0); }).substr(0, 6), "period");
  EXPECT_EQ(message([](auto& o) { o = some_spectrum(3); }),
            "the spectrum is of 3 dimensions; it must be of 2");
}

}  // namespace
}  // namespace solidnoise::spectrum_noise_test
