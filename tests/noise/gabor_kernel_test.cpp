#include "solidnoise/noise/kernel/gabor_kernel.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "support/golden.h"
#include "support/relative_error.h"

namespace solidnoise::gabor_kernel_test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
constexpr double kExact =
    1e-9;  // golden values are exact; closed forms in double precision lose a few digits

// A frequency of length f in no special direction.
template <int Dim>
Vec<Dim> oblique(double f) {
  Vec<Dim> w;
  double squared = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    w[axis] = 1.0 - 0.6 * axis;
    squared += w[axis] * w[axis];
  }
  return w * (f / std::sqrt(squared));
}

template <int Dim>
RandomPhaseGaborKernel<Dim> random_phase(const json& golden_case) {
  return {golden_case["K"], golden_case["a"], oblique<Dim>(golden_case["F0"])};
}

// Integral over the plane of a function that is negligible beyond 4.
template <typename Function>
auto plane_integral(const Function& function) {
  const QuadratureRule rule = gauss_legendre(120);
  decltype(function(Vec<2>(0.0))) sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      sum += 16.0 * rule.weights[i] * rule.weights[j] * function(4.0 * Vec<2>(rule.nodes[i], rule.nodes[j]));
    }
  }
  return sum;
}

TEST(RandomPhaseGaborKernel, EnergyAgreesWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    EXPECT_TRUE(within(kExact, random_phase<Dim>(expected).energy(), expected["int_g2_aniso_random_phase"]));
  });
}

TEST(RandomPhaseGaborKernel, RelativeErrorAndItsRadiusAgreeWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto random = random_phase<Dim>(expected);
    for (const json& at : expected["relerr_at"]) {
      EXPECT_TRUE(within(kExact, random.relative_error(at["r"]), at["aniso_rp"]));
    }
    for (const std::string error : {"0.05", "0.02"}) {
      const json& radius = expected["radius"];
      EXPECT_TRUE(
          within(kExact, random.radius_for_error(std::stod(error)), radius["aniso_rp_relerr_" + error]));
    }
  });
}

TEST(RandomPhaseGaborKernel, RelativeErrorInTwoDimensionsIsTheGaussian) {
  // Q(1, x) = exp(-x): the error at radius r is the envelope there.
  const RandomPhaseGaborKernel<2> kernel(1.0, 2.0, {3.0, 1.0});
  EXPECT_TRUE(within(1e-12, kernel.relative_error(0.7), std::exp(-kPi * 4.0 * 0.49)));
}

TEST(RandomPhaseGaborKernel, IsotropicSpectrumAgreesWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = random_phase<Dim>(expected);
    for (const json& at : expected["psd_random_orientation_rp_over_lambda_EW2eq1"]) {
      EXPECT_TRUE(within(kExact, kernel.isotropic_power_spectrum(at["f"]), at["S"]));
    }
  });
}

TEST(RandomPhaseGaborKernel, FilteringMultipliesTheSpectrumByTheResponse) {
  const RandomPhaseGaborKernel<3> kernel(1.3, 0.8, {0.9, -0.4, 0.2});
  const double b = 0.6;
  const RandomPhaseGaborKernel<3> filtered = kernel.filtered(b);
  for (const Vec<3> f : {Vec<3>(0.0), Vec<3>(0.9, -0.4, 0.2), Vec<3>(-0.5, 0.1, 0.7)}) {
    const double response = std::exp(-2.0 * kPi * (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (b * b));
    EXPECT_TRUE(within(1e-12, filtered.power_spectrum(f), response * kernel.power_spectrum(f)));
  }
}

TEST(RandomPhaseGaborKernel, StatisticsAreMeansOverThePhase) {
  const RandomPhaseGaborKernel<2> kernel(1.3, 1.1, {0.5, -0.4});
  const Vec<2> f(0.6, 0.1);
  const Vec<2> x(0.3, 0.4);
  // All are trigonometric polynomials of at most the fourth degree in the phase: eight phases give the mean.
  double spectrum = 0.0;
  double energy = 0.0;
  double fourth = 0.0;
  double autocorrelation = 0.0;
  for (int i = 0; i < 8; ++i) {
    const auto value = [&](const Vec<2>& y) {
      const double wave = 2.0 * kPi * (0.5 * y.x - 0.4 * y.y) + 0.3 + 2.0 * kPi * i / 8.0;
      return 1.3 * std::exp(-kPi * 1.1 * 1.1 * (y.x * y.x + y.y * y.y)) * std::cos(wave);
    };
    spectrum += std::norm(plane_integral([&](const Vec<2>& y) {
                  return value(y) * std::polar(1.0, -2.0 * kPi * (f.x * y.x + f.y * y.y));
                })) /
                8.0;
    energy += plane_integral([&](const Vec<2>& y) { return std::pow(value(y), 2); }) / 8.0;
    fourth += plane_integral([&](const Vec<2>& y) { return std::pow(value(y), 4); }) / 8.0;
    autocorrelation += plane_integral([&](const Vec<2>& y) { return value(y) * value(y + x); }) / 8.0;
  }
  EXPECT_TRUE(within(1e-12, kernel.power_spectrum(f), spectrum));
  EXPECT_TRUE(within(1e-12, kernel.energy(), energy));
  EXPECT_TRUE(within(1e-12, kernel.fourth_moment(), fourth));
  EXPECT_TRUE(within(1e-11, kernel.autocorrelation(x), autocorrelation));
}

TEST(RandomPhaseGaborKernel, IsotropicSpectrumIsTheMeanOverDirections) {
  const RandomPhaseGaborKernel<2> kernel(1.3, 1.1, {0.5, -0.4});
  const double f = 0.8;
  double mean = 0.0;
  constexpr int kDirections = 64;  // a smooth periodic function: the mean over even steps is exact
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * i / kDirections;
    mean += kernel.power_spectrum(f * Vec<2>(std::cos(angle), std::sin(angle))) / kDirections;
  }
  EXPECT_TRUE(within(1e-12, kernel.isotropic_power_spectrum(f), mean));
}

TEST(RandomPhaseGaborKernel, RefusesParametersThatMakeNoKernel) {
  EXPECT_THROW(RandomPhaseGaborKernel<2>(-1.0, 1.0, {1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(RandomPhaseGaborKernel<2>(1.0, 1.0, {std::nan(""), 0.0}), std::invalid_argument);
  EXPECT_THROW(RandomPhaseGaborKernel<2>(1.0, -1.0, {1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(RandomPhaseGaborKernel<2>(1.0, 1.0, {1.0, 0.0}).radius_for_error(2.0), std::invalid_argument);
}

TEST(EvenGaborKernel, MomentsAreTheIntegrals) {
  const double f0 = 0.8;
  for (const double a : {0.7, 1.0}) {
    const EvenGaborKernel<2> kernel(a, f0);
    const auto value = [&](const Vec<2>& x) {
      return std::exp(-kPi * a * a * (x.x * x.x + x.y * x.y)) * std::cos(2.0 * kPi * f0 * x.x);
    };
    EXPECT_NEAR(plane_integral([&](const Vec<2>& x) { return std::pow(value(x), 2); }), kernel.energy(),
                1e-9);
    EXPECT_NEAR(plane_integral([&](const Vec<2>& x) { return std::pow(value(x), 4); }),
                kernel.fourth_moment(), 1e-9);
    for (const double f : {0.0, 0.5, 0.9, 1.7}) {
      constexpr int kTurns = 48;
      double mean = 0.0;
      for (int turn = 0; turn < kTurns; ++turn) {
        const double angle = 2.0 * kPi * turn / kTurns;
        const auto transform = plane_integral([&](const Vec<2>& x) {
          const double phase = 2.0 * kPi * f * (std::cos(angle) * x.x + std::sin(angle) * x.y);
          return std::pow(value(x), 2) * std::polar(1.0, phase);
        });
        mean += std::norm(transform) / kTurns;
      }
      EXPECT_NEAR(kernel.squared_power(f), mean, 1e-6 * kernel.squared_power(0.0)) << a << ", " << f;
    }
  }
}

}  // namespace
}  // namespace solidnoise::gabor_kernel_test
