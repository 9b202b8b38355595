#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"

namespace solidnoise::gabor_statistics_test {
namespace {

// Even cumulants of a noise's values, of orders 2 to 8; the odd ones are 0.
using Cumulants = std::array<double, 4>;

// Campbell's theorem: density E[W^m] times the integral of the m-th power of the kernel.
template <int Dim>
Cumulants cumulants_of(const GaborNoise<Dim>& noise) {
  Cumulants cumulants;
  for (std::size_t i = 0; i < cumulants.size(); ++i) {
    const int order = 2 * static_cast<int>(i) + 2;
    const double integral =
        unit_sphere_area(Dim) *
        integrate(
            [&](double r) { return std::pow(noise.compact_kernel().value(r), order) * std::pow(r, Dim - 1); },
            0.0, noise.radius(), 100);
    const double weights = noise.options().weights == ImpulseWeights::uniform ? 1.0 / (order + 1) : 1.0;
    cumulants[i] = noise.impulse_density() * weights * std::pow(noise.amplitude(), order) * integral;
  }
  return cumulants;
}

// With the mean of the m-th power of a cosine in place of that of the weight.
template <int Dim>
Cumulants cumulants_of(const OrientedGaborNoise<Dim>& noise) {
  constexpr std::array kCosines = {1.0 / 2.0, 3.0 / 8.0, 5.0 / 16.0, 35.0 / 128.0};
  Cumulants cumulants;
  for (std::size_t i = 0; i < cumulants.size(); ++i) {
    const int order = 2 * static_cast<int>(i) + 2;
    const double along_axis =
        2.0 * integrate([&](double d) { return std::pow(noise.envelope().value(d), order); }, 0.0,
                        noise.envelope().radius(), 20);
    cumulants[i] = noise.impulse_density() * kCosines[i] * std::pow(noise.amplitude(), order) *
                   std::pow(along_axis, Dim);
  }
  return cumulants;
}

double fourth_moment(const Cumulants& k) {
  return k[1] + 3.0 * k[0] * k[0];
}

double eighth_moment(const Cumulants& k) {
  const double variance = k[0];
  return k[3] + 28.0 * k[2] * variance + 35.0 * k[1] * k[1] + 210.0 * k[1] * variance * variance +
         105.0 * std::pow(variance, 4);
}

// Mean, variance and fourth moment of the values at places too far apart for one kernel. Of strata, by the
// standard errors that the values have themselves.
template <int Dim, template <int> class Noise>
void expect_stated_moments(const Noise<Dim>& noise, double origin = 0.0) {
  const auto values = values_of<Dim>(noise, independent_lattice<Dim>(support_of(noise), origin));
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), noise.variance());
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                        3.0 + noise.excess_kurtosis());
}

// Of a Poisson process, whose values at independent positions are within 4 standard errors by the closed
// forms.
template <int Dim, template <int> class Noise>
void expect_closed_forms(const Noise<Dim>& noise, double origin = 0.0) {
  const Cumulants cumulants = cumulants_of(noise);
  EXPECT_NEAR(cumulants[0], noise.variance(), 1e-9);
  EXPECT_NEAR(cumulants[1], noise.excess_kurtosis(), 1e-6 * cumulants[1]);

  const auto values = values_of<Dim>(noise, independent_lattice<Dim>(support_of(noise), origin));
  const double count = static_cast<double>(values.size());
  const auto moment = [&](int order) {
    return estimate_mean(values, [order](double x) { return std::pow(x, order); }).mean;
  };
  const double fourth = fourth_moment(cumulants);
  const double variance_error = std::sqrt((fourth - 1.0) / count);
  EXPECT_LT(variance_error, 0.06);  // else the test says little
  EXPECT_NEAR(moment(1), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(moment(2), 1.0, 4.0 * variance_error);
  EXPECT_NEAR(moment(4), fourth, 4.0 * std::sqrt((eighth_moment(cumulants) - fourth * fourth) / count));
}

// Numbers of impulses, from very few to many, with bandwidths: where these are narrow, isotropic kernels are
// peaked, and few of them say little about the variance.
struct Setting {
  double impulses;
  double bandwidth;
  ImpulseWeights weights;
  double anisotropy;
};
constexpr Setting kSettings[] = {{4.0, 2.0, ImpulseWeights::signs, 0.0},
                                 {32.0, 1.0, ImpulseWeights::uniform, 0.5},
                                 {32.0, 1.0, ImpulseWeights::signs, 1.0},
                                 {100.0, 0.25, ImpulseWeights::signs, 0.0}};

TEST(GaborStatistics, MeanVarianceAndKurtosisAreTheClosedForms) {
  for_each_dimension([]<int Dim>() {
    for (const Setting& setting : kSettings) {
      SCOPED_TRACE(testing::Message() << setting.impulses << " impulses, bandwidth " << setting.bandwidth);
      GaborNoiseOptions isotropic;
      isotropic.bandwidth = setting.bandwidth;
      isotropic.impulses = setting.impulses;
      isotropic.weights = setting.weights;
      isotropic.seed = 41;
      expect_stated_moments<Dim>(GaborNoise<Dim>(isotropic));
      isotropic.impulses_process = ImpulseSpread::poisson;
      expect_closed_forms<Dim>(GaborNoise<Dim>(isotropic));

      SCOPED_TRACE(testing::Message() << "oriented, anisotropy " << setting.anisotropy);
      OrientedGaborNoiseOptions oriented;
      oriented.bandwidth = setting.bandwidth;
      oriented.impulses = setting.impulses;
      oriented.anisotropy = setting.anisotropy;
      oriented.direction = Vec<4>(-0.4, 1.0, 0.2, 0.1);
      oriented.seed = 42;
      expect_stated_moments<Dim>(OrientedGaborNoise<Dim>(oriented));
      oriented.impulses_process = ImpulseSpread::poisson;
      expect_closed_forms<Dim>(OrientedGaborNoise<Dim>(oriented));
    }
  });
}

TEST(GaborStatistics, AreTheSameFarFromTheOriginOnBothSides) {
  for_each_dimension([]<int Dim>() {
    for (const double origin : {-1e6, 1e6}) {
      expect_stated_moments<Dim>(GaborNoise<Dim>(GaborNoiseOptions{.impulses = 50.0}), origin);
      expect_stated_moments<Dim>(OrientedGaborNoise<Dim>(OrientedGaborNoiseOptions{}), origin);
    }
  });
}

TEST(GaborStatistics, DefaultNumberOfImpulsesTakesTheExcessKurtosisAway) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.7, 1.0, 2.0}) {
      const GaborNoise<Dim> isotropic(GaborNoiseOptions{.bandwidth = bandwidth});
      EXPECT_LT(std::abs(isotropic.excess_kurtosis()), 0.02) << bandwidth;
      EXPECT_LE(isotropic.kurtosis_given_place(), 0.26) << bandwidth;
      const OrientedGaborNoise<Dim> oriented(OrientedGaborNoiseOptions{.bandwidth = bandwidth});
      EXPECT_LT(std::abs(oriented.excess_kurtosis()), 0.02) << bandwidth;
      EXPECT_LE(oriented.kurtosis_given_place(), 0.26) << bandwidth;
    }
  });
}

TEST(GaborStatistics, DefaultNumberOfImpulsesOfAPoissonProcessBringsTheExcessKurtosisBelowAHalf) {
  constexpr auto kPoisson = ImpulseSpread::poisson;
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.25, 1.0, 2.0}) {
      const GaborNoise<Dim> isotropic(
          GaborNoiseOptions{.bandwidth = bandwidth, .impulses_process = kPoisson});
      EXPECT_NEAR(isotropic.excess_kurtosis(), 0.5, 0.1);
      const OrientedGaborNoise<Dim> oriented(
          OrientedGaborNoiseOptions{.bandwidth = bandwidth, .impulses_process = kPoisson});
      EXPECT_NEAR(oriented.excess_kurtosis(), 0.5, 0.1);
      EXPECT_LE(oriented.impulses_per_kernel(), isotropic.impulses_per_kernel() + 1.0);
    }
  });
}

// One impulse in each balanced cube. Of a Poisson process of as many the sixth cumulant is 19 and 6 times as
// large.
TEST(GaborStatistics, SixthCumulantOfStrataIsTheClosedForm) {
  const auto check = []<int Dim>(double expected, int seeds) {
    OrientedGaborNoiseOptions options{.frequency = 1.0};
    const auto kernel = OrientedGaborNoise<Dim>(options).kernel();
    const StrataChoice choice = strata_choice(kernel);
    const double density = std::pow(choice.balanced_side(), -Dim);
    const double scale = std::pow(density / std::pow(kernel.a(), Dim), 2);
    options.impulses = impulses_in_ball(Dim, density, choice.radius);
    std::vector<double> estimates;
    for (int seed = 0; seed < seeds; ++seed) {
      options.seed = static_cast<std::uint64_t>(seed);
      const OrientedGaborNoise<Dim> noise(options);
      const auto values = values_of<Dim>(noise, independent_lattice<Dim>(support_of(noise)));
      const auto moment = [&](int order) {
        return estimate_mean(values, [&](double x) { return std::pow(x, order); }).mean;
      };
      estimates.push_back(scale * (moment(6) - 15.0 * moment(4) * moment(2) + 30.0 * std::pow(moment(2), 3)));
    }
    const Estimate estimate = estimate_mean(estimates, [](double x) { return x; });
    expect_within_4_sigma(estimate, expected);
    EXPECT_LT(estimate.error, 0.35 * expected);
  };
  check.template operator()<2>(0.176, 60);
  check.template operator()<3>(0.641, 40);
}

// What an error is allowed for does not move impulses: a draft is the final, up to its error.
TEST(GaborStatistics, ADraftShowsTheFinal) {
  for_each_dimension([]<int Dim>() {
    const auto values = []<typename Options>(Options options, double error) {
      options.error = error;
      options.seed = 5;
      Lattice<Dim> lattice;
      lattice.step = Vec<Dim>(0.31 / options.frequency);
      lattice.count = glm::vec<Dim, int>(std::array{4000, 80, 20, 9}[Dim - 1]);
      return values_of<Dim>(*make_noise<Dim>(NoiseRecipe{options, {}}), lattice);
    };
    const auto correlation = [&](const auto& options) {
      const auto draft = values(options, 0.05);
      const auto fine = values(options, 0.002);
      double product = 0.0;
      double squares[2] = {};
      for (std::size_t i = 0; i < draft.size(); ++i) {
        product += static_cast<double>(draft[i]) * static_cast<double>(fine[i]);
        squares[0] += std::pow(static_cast<double>(draft[i]), 2);
        squares[1] += std::pow(static_cast<double>(fine[i]), 2);
      }
      return product / std::sqrt(squares[0] * squares[1]);
    };
    EXPECT_GT(correlation(GaborNoiseOptions{}), 0.999);
    EXPECT_GT(correlation(OrientedGaborNoiseOptions{}), 0.999);
  });
}

// Mean squares of the derivatives per axis: (2 pi f)^2 times the spectrum, in closed form from the kernels.
template <int Dim>
double mean_square_derivative(const GaborNoise<Dim>& noise, int) {
  const auto& kernel = noise.compact_kernel();
  const double slopes =
      unit_sphere_area(Dim) *
      integrate([&](double r) { return std::pow(kernel.derivative(r), 2) * std::pow(r, Dim - 1); }, 0.0,
                noise.radius(), 100);
  return slopes / kernel.energy() / Dim;
}
template <int Dim>
double mean_square_derivative(const OrientedGaborNoise<Dim>& noise, int axis) {
  const auto& envelope = noise.envelope();
  const double slopes = 2.0 * integrate([&](double d) { return std::pow(envelope.derivative(d), 2); }, 0.0,
                                        envelope.radius(), 20);
  const double frequency = noise.options().frequency;
  const double wave = noise.options().anisotropy == 1.0
                          ? std::pow(frequency * noise.directions().axis()[axis], 2)
                          : frequency * frequency / Dim;
  return slopes / envelope.energy() + std::pow(2.0 * std::numbers::pi, 2) * wave;
}

TEST(GaborStatistics, DerivativesAlongEveryAxisTimeIncludedAreTheClosedForms) {
  for_each_dimension([]<int Dim>() {
    const auto check = [](const auto& noise) {
      if constexpr (requires { noise.options().anisotropy; }) {
        if (noise.options().anisotropy == 0.5) return;  // no closed form
      }
      const Lattice<Dim> lattice = independent_lattice<Dim>(support_of(noise));
      Evaluated<Dim> samples(lattice.size());
      noise.evaluate(lattice, samples.samples());
      for (int axis = 0; axis < Dim; ++axis) {
        SCOPED_TRACE(testing::Message() << "axis " << axis);
        const auto& derivatives = samples.gradient[static_cast<std::size_t>(axis)];
        expect_within_4_sigma(estimate_mean(derivatives, [](double x) { return x; }), 0.0);
        expect_within_4_sigma(estimate_mean(derivatives, [](double x) { return x * x; }),
                              mean_square_derivative<Dim>(noise, axis));
      }
    };
    for_each_gabor_noise<Dim>(check);
  });
}

TEST(GaborStatistics, AFrameHasTheMomentsOfTheWhole) {
  const auto check = [](const auto& noise) {
    const auto shared = std::make_shared<std::decay_t<decltype(noise)>>(noise);
    for (const double t : {0.0, -12.34}) {
      const auto frame = slice(shared, t);
      const auto values = values_of<3>(*frame, independent_lattice<3>(support_of(noise)));
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), frame->variance());
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                            frame->excess_kurtosis() + 3.0);
    }
  };
  for_each_gabor_noise<4>(check);
}

}  // namespace
}  // namespace solidnoise::gabor_statistics_test
