#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::gaussian_filter_test {
namespace {

constexpr double kPi = std::numbers::pi;

// What a Gaussian of standard deviation s lets pass of a wave's amplitude.
double response(double s, double f) {
  return std::exp(-2.0 * std::pow(kPi * s * f, 2));
}

// The same noise, convolved with a Gaussian.
template <typename Noise>
Noise filtered(const Noise& noise, double deviation) {
  auto options = noise.options();
  options.filter = deviation;
  return Noise(options);
}

// The radial density of the variance of an isotropic noise, by its closed form.
template <int Dim, typename Function>
double integrate_spectrum(const Noise<Dim>& noise, const Function& weight) {
  return unit_sphere_area(Dim) * integrate(
                                     [&](double f) {
                                       Vec<Dim> along(0.0);
                                       along[0] = f;
                                       return noise.power_spectrum(along) * weight(f) * std::pow(f, Dim - 1);
                                     },
                                     0.0, 4.0, 64);
}

// The power spectrum of the kernel before it is made compact, of noises that are isotropic.
template <int Dim>
double kernel_power(const GaborNoise<Dim>& noise, double f) {
  return std::pow(noise.kernel().spectrum(f), 2);
}
template <int Dim>
double kernel_power(const OrientedGaborNoise<Dim>& noise, double f) {
  return noise.kernel().isotropic_power_spectrum(f);
}

template <typename Noise>
bool is_isotropic(const Noise& noise) {
  if constexpr (requires { noise.options().anisotropy; }) return noise.options().anisotropy == 0.0;
  return true;
}

TEST(GaussianFilter, SpectrumAndVarianceAreWhatTheFilterLeaves) {
  for_each_dimension([]<int Dim>() {
    for (const double deviation : {0.05, 0.2, 0.3}) {
      const auto check = [&](const auto& noise) {
        const auto passed = filtered(noise, deviation);
        ASSERT_GT(passed.variance(), 0.0);
        if (!is_isotropic(noise)) return;
        const auto squared_response = [&](double f) { return std::pow(response(deviation, f), 2); };
        for (const double f : {0.3, 0.7, 1.0, 1.4}) {
          const double expected = kernel_power(noise, f) * squared_response(f);
          EXPECT_NEAR(kernel_power(passed, f), expected, 1e-9 * expected);
        }
        // Both are off by the error, in their norms.
        EXPECT_NEAR(std::sqrt(passed.variance()), std::sqrt(integrate_spectrum<Dim>(noise, squared_response)),
                    2.0 * noise.options().error);
        EXPECT_NEAR(integrate_spectrum<Dim>(passed, [](double) { return 1.0; }), passed.variance(),
                    1e-5);  // compact: a tail above 4
      };
      for_each_gabor_noise<Dim>(check, 1.0, 0.002);
    }
  });
}

// A periodic tile convolved with a Gaussian, axis by axis; `deviation` in samples.
template <int Dim>
std::vector<double> convolved(const std::vector<float>& tile, int side, double deviation) {
  std::vector<double> taps;
  double sum = 0.0;
  const int reach = static_cast<int>(std::ceil(7.0 * deviation));  // exp(-24) is left out
  for (int i = -reach; i <= reach; ++i) {
    taps.push_back(std::exp(-0.5 * std::pow(i / deviation, 2)));
    sum += taps.back();
  }
  std::vector<double> values(tile.begin(), tile.end());
  std::size_t stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const std::vector<double> from = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int place = static_cast<int>(i / stride % static_cast<std::size_t>(side));
      const std::size_t row = i - static_cast<std::size_t>(place) * stride;
      values[i] = 0.0;
      for (int k = -reach; k <= reach; ++k) {
        const int other = ((place + k) % side + side) % side;
        values[i] += taps[static_cast<std::size_t>(k + reach)] / sum *
                     from[row + static_cast<std::size_t>(other) * stride];
      }
    }
    stride *= static_cast<std::size_t>(side);
  }
  return values;
}

// A lattice over one period.
template <int Dim>
Lattice<Dim> tile_lattice(int side, double period) {
  Lattice<Dim> lattice;
  lattice.step = Vec<Dim>(period / side);
  lattice.count = glm::vec<Dim, int>(side);
  return lattice;
}

// Samples are so near each other that a sum over them is the integral to 1e-6: 8 per cycle, and the
// filter 1.6 of them wide or more.
template <int Dim>
void expect_convolution(double bandwidth, double deviation) {
  constexpr int kSide = Dim == 3 ? 64 : 128;
  constexpr double kPeriod = kSide / 8.0;
  const auto check = [&](const auto& noise) {
    const Lattice<Dim> lattice = tile_lattice<Dim>(kSide, kPeriod);
    const auto passed = filtered(noise, deviation);
    ASSERT_GT(passed.variance(), 0.0);
    const auto expected = convolved<Dim>(values_of<Dim>(noise, lattice), kSide, deviation * kSide / kPeriod);
    const auto values = values_of<Dim>(passed, lattice);
    double squares = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) squares += std::pow(values[i] - expected[i], 2);
    // Each of the two is off by the error at most. A kernel can hardly be as far off as that in what a filter
    // lets pass, so that there is room for the tile's own share of impulses.
    const double rms = std::sqrt(squares / static_cast<double>(values.size()));
    EXPECT_LT(rms, 2.0 * noise.options().error) << "deviation " << deviation;
    EXPECT_GT(std::sqrt(passed.variance()), 4.0 * rms);  // else the test says little
  };
  for_each_gabor_noise<Dim>(check, bandwidth, 0.01, Vec<4>(kPeriod));
}

TEST(GaussianFilter, IsAConvolutionOfTheSameNoise) {
  for (const double deviation : {0.2, 0.3}) {
    expect_convolution<1>(1.0, deviation);
    expect_convolution<2>(1.0, deviation);
    expect_convolution<2>(0.5, deviation);
    expect_convolution<3>(1.0, deviation);
  }
  // Filters several times as wide as the kernel, which then reaches several cells.
  expect_convolution<1>(4.0, 0.7);
  expect_convolution<2>(4.0, 0.5);
}

// Of two bands of several waves, each of which the filter leaves another part of.
TEST(GaussianFilter, OfASpectrumIsAConvolutionOfTheSameNoise) {
  constexpr int kSide = 128;
  constexpr double kPeriod = 16.0;
  SpectrumNoiseOptions options = some_spectrum(2);
  options.period = Vec<4>(kPeriod, kPeriod, 0.0, 0.0);
  options.error = 0.01;
  const Lattice<2> lattice = tile_lattice<2>(kSide, kPeriod);
  const SpectrumNoise<2> noise(options);
  for (const double deviation : {0.1, 0.25}) {
    options.filter = deviation;
    const SpectrumNoise<2> passed(options);
    const double b = filter_bandwidth(deviation);
    // By the closed form; bands are each off by the error.
    EXPECT_NEAR(std::sqrt(passed.variance()), std::sqrt(noise.spectrum().filtered(b).variance()),
                2.0 * options.error);
    for (const Vec<2> f : {Vec<2>(0.3, 0.1), Vec<2>(0.9, 0.3), Vec<2>(0.5, -0.8)}) {
      const double expected = noise.power_spectrum(f) * std::pow(response(deviation, glm::length(f)), 2);
      EXPECT_NEAR(passed.power_spectrum(f), expected, 0.02 * expected);
    }
    const auto expected = convolved<2>(values_of<2>(noise, lattice), kSide, deviation * kSide / kPeriod);
    const auto values = values_of<2>(passed, lattice);
    double squares = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) squares += std::pow(values[i] - expected[i], 2);
    // As of other noises.
    const double rms = std::sqrt(squares / static_cast<double>(values.size()));
    EXPECT_LT(rms, 2.0 * options.error) << "deviation " << deviation;
    EXPECT_GT(std::sqrt(passed.variance()), 4.0 * rms);
    // At points as on the lattice.
    std::vector<float> at_points(1);
    const std::vector<Vec<2>> somewhere{{lattice.coordinate(0, 5), lattice.coordinate(1, 70)}};
    passed.evaluate(Points<2>{somewhere}, {at_points, {}});
    EXPECT_NEAR(at_points[0], values[5 * kSide + 70], 1e-5);
  }
  options.filter = 20.0;
  EXPECT_EQ(SpectrumNoise<2>(options).variance(), 0.0);
}

TEST(GaussianFilter, OfAnIsotropicSpectrumLeavesItsVariance) {
  SpectrumNoiseOptions options = some_spectrum(3, true);
  options.filter = 0.2;
  const SpectrumNoise<3> passed(options);
  const auto values = values_of<3>(passed, independent_lattice<3>(support_of(options)));
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), passed.variance());
  EXPECT_NEAR(std::sqrt(passed.variance()),
              std::sqrt(SpectrumNoise<3>(some_spectrum(3, true))
                            .spectrum()
                            .filtered(filter_bandwidth(options.filter))
                            .variance()),
              2.0 * options.error);
}

TEST(GaussianFilter, ValuesAndDerivativesAreThoseOfTheFilteredKernels) {
  for_each_dimension([]<int Dim>() {
    if constexpr (Dim == 4) return;
    const auto check = [](const auto& noise) {
      for (const double deviation : {0.1, 0.45}) {
        const auto passed = filtered(noise, deviation);
        if (passed.variance() == 0.0) continue;
        const Lattice<Dim> lattice = some_lattice<Dim>(support_of(noise));
        const Evaluated<Dim> samples = evaluate_in_one_block<Dim>(passed, lattice);
        for (std::size_t i = 0; i < lattice.size(); i += 97) {
          const auto expected = reference_sample<Dim>(passed, sample_position(lattice, i));
          // Single precision, in kernels of up to 1e4 times the sum's terms.
          EXPECT_NEAR(samples.values[i], expected.value, 2e-4);
          for (std::size_t axis = 0; axis < Dim; ++axis) {
            EXPECT_NEAR(samples.gradient[axis][i], expected.derivative[axis], 2e-3);
          }
        }
      }
    };
    for_each_gabor_noise<Dim>(check);
    for_each_gabor_noise<Dim>(check, 4.0);
  });
}

TEST(GaussianFilter, MomentsOfTheValuesAreTheClosedForms) {
  for (const double deviation : {0.15, 0.3}) {
    const auto check = [&](const auto& noise) {
      const auto passed = filtered(noise, deviation);
      const auto values = values_of<3>(passed, independent_lattice<3>(support_of(passed)));
      const double variance = passed.variance();
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), variance);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                            (passed.excess_kurtosis() + 3.0) * variance * variance);
    };
    for_each_gabor_noise<3>(check);
  }
}

// From one resolution to the next: the difference is what one filter lets pass and the other does not.
TEST(GaussianFilter, AnotherFilterChangesValuesByWhatItPassesOnly) {
  const auto check = [](const auto& noise) {
    if (!is_isotropic(noise)) return;
    const auto coarse = filtered(noise, 0.2);
    const auto fine = filtered(noise, 0.1);
    const Lattice<3> lattice = independent_lattice<3>(support_of(noise));
    const auto coarse_values = values_of<3>(coarse, lattice);
    auto differences = values_of<3>(fine, lattice);
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] -= coarse_values[i];
    const double expected = integrate_spectrum<3>(
        noise, [](double f) { return std::pow(response(0.1, f) - response(0.2, f), 2); });
    const Estimate squares = estimate_mean(differences, [](double x) { return x * x; });
    const double error = noise.options().error;
    EXPECT_NEAR(std::sqrt(squares.mean), std::sqrt(expected),
                4.0 * squares.error / (2.0 * std::sqrt(expected)) + 2.0 * error);
  };
  for_each_gabor_noise<3>(check, 1.0, 0.005);
}

TEST(GaussianFilter, WhatIsBelowTheErrorIsNothing) {
  const auto check = [](const auto& noise) {
    const auto silent = filtered(noise, 2.0);
    EXPECT_EQ(silent.variance(), 0.0);
    EXPECT_EQ(silent.excess_kurtosis(), 0.0);
    EXPECT_EQ(silent.band().upper, 0.0);
    EXPECT_EQ(silent.power_spectrum({1.0, 0.0, 0.0}), 0.0);
    const Lattice<3> lattice = some_lattice<3>(1.0);
    Evaluated<3> samples(lattice.size());
    samples.values[0] = samples.gradient[2][0] = 7.0f;
    silent.evaluate(lattice, samples.samples());
    EXPECT_EQ(samples, Evaluated<3>(lattice.size()));
  };
  for_each_gabor_noise<3>(check);
}

TEST(GaussianFilter, OctavesOfWhichNothingIsLeftCostNothing) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0, .filter = 0.2};
  recipe.fractal = {.octaves = 3, .renormalize = false};
  const Lattice<2> lattice = some_lattice<2>(1.0);
  const auto few = make_noise<2>(recipe);
  recipe.fractal.octaves = 16;  // up to frequency 32768
  const auto many = make_noise<2>(recipe);
  EXPECT_EQ(values_of<2>(*many, lattice), values_of<2>(*few, lattice));
  EXPECT_EQ(many->variance(), few->variance());

  std::get<GaborNoiseOptions>(recipe.noise).filter = 100.0;
  const auto none = make_noise<2>(recipe);
  EXPECT_EQ(none->variance(), 0.0);
  EXPECT_EQ(none->excess_kurtosis(), 0.0);
  EXPECT_EQ(none->band().upper, 0.0);
  EXPECT_EQ(values_of<2>(*none, lattice), std::vector<float>(lattice.size(), 0.0f));
}

TEST(GaussianFilter, TilesAndFramesStayExact) {
  const auto check = [](const auto& noise) {
    auto options = noise.options();
    options.filter = 0.3;
    options.evolution = {.rate = 1.0, .time = 0.3, .loop = 2.0};
    const std::decay_t<decltype(noise)> passed(options);
    const Lattice<2> lattice = tile_lattice<2>(24, 6.0);
    Lattice<2> next = lattice;
    next.first[1] += 24;
    EXPECT_EQ(evaluate_in_one_block<2>(passed, next), evaluate_in_one_block<2>(passed, lattice));
    options.evolution.time += 2.0;
    EXPECT_EQ(evaluate_in_one_block<2>(std::decay_t<decltype(noise)>(options), lattice),
              evaluate_in_one_block<2>(passed, lattice));
  };
  for_each_gabor_noise<2>(check, 1.0, 0.02, Vec<4>(6.0));
}

TEST(GaussianFilter, BadOptionsAreRefused) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { GaborNoise<3>{GaborNoiseOptions{.filter = -1.0}}; }),
            "filter is -1; it must be between 0 and 1000000000 (world units; 0 for none)");
  EXPECT_EQ(message_of<std::invalid_argument>(
                [] { OrientedGaborNoise<3>{OrientedGaborNoiseOptions{.filter = NAN}}; }),
            "filter is nan; it must be between 0 and 1000000000 (world units; 0 for none)");
}

}  // namespace
}  // namespace solidnoise::gaussian_filter_test
