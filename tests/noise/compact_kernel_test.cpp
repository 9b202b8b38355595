#include "solidnoise/noise/kernel/compact_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise::compact_kernel_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Settings that span what the options allow.
struct Setting {
  double octaves;
  double error;
  double frequency;
};
constexpr Setting kSettings[] = {{1.0, 0.02, 8.0},  {1.0, 1e-4, 1.0}, {1.0, 0.5, 1e-3}, {0.05, 0.02, 1.0},
                                 {0.05, 1e-4, 3.0}, {0.05, 0.5, 1.0}, {4.0, 0.02, 1e4}, {4.0, 1e-4, 1.0},
                                 {4.0, 0.5, 1.0},   {2.0, 0.1, 1.0},  {0.3, 0.005, 1.0}};

template <int Dim>
IsotropicGaborKernel<Dim> kernel_of(const Setting& setting) {
  return IsotropicGaborKernel<Dim>::with_unit_peak(setting.frequency,
                                                   gaussian_parameter(setting.frequency, setting.octaves));
}

// Runs a check, a template on the dimension, for every dimension and setting.
template <typename Check>
void for_each_kernel(const Check& check) {
  for (const Setting& setting : kSettings) {
    SCOPED_TRACE(testing::Message() << setting.octaves << " octaves, error " << setting.error);
    [&]<int... I>(std::integer_sequence<int, I...>) {
      (check(kernel_of<I + 1>(setting), setting), ...);
    }
    (std::make_integer_sequence<int, 4>());
  }
}

// Integral over the ball of a compact kernel. With r = R sin(angle), a polynomial in r oscillates evenly in
// the angle; 200 panels resolve the fourth power of the highest degree.
template <typename Function>
double ball_integral(const CompactKernel& compact, const Function& function) {
  const int n = compact.dimensions();
  const auto shell = [&](double angle) {
    const double r = compact.radius() * std::sin(angle);
    return function(r) * std::pow(r, n - 1) * compact.radius() * std::cos(angle);
  };
  return unit_sphere_area(n) * integrate(shell, 0.0, kPi / 2.0, 200);
}

TEST(CompactKernel, HasTheRequestedErrorAgainstTheUnlimitedKernel) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    const double inside =
        ball_integral(compact, [&](double r) { return std::pow(kernel.value(r) - compact.value(r), 2); });
    const double tail = kernel.energy() * std::pow(kernel.relative_error(compact.radius()), 2);
    const double measured = std::sqrt((inside + tail) / kernel.energy());
    // Both come from quadratures exact to about 1e-14 of the energy, of which the squared error is 1e-8 or
    // more.
    EXPECT_NEAR(measured / setting.error, 1.0, 1e-5) << Dim;
    EXPECT_NEAR(compact.relative_error() / setting.error, 1.0, 1e-5) << Dim;
  });
}

TEST(CompactKernel, AtAGivenRadiusHasTheLowestDegreeWithinTheError) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel cheapest = compact_kernel(kernel, setting.error);
    // Where the cheapest one reaches the error exactly, any margin lets the same degree pass.
    const double radius = cheapest.radius();
    const CompactKernel same = compact_kernel_at(kernel, radius, setting.error * (1.0 + 1e-6));
    EXPECT_EQ(same.degree(), cheapest.degree());
    EXPECT_EQ(same.radius(), radius);
    EXPECT_LE(compact_kernel_at(kernel, 1.1 * radius, setting.error).relative_error(), setting.error);
  });
}

TEST(CompactKernel, RefusesARadiusThatLeavesTooMuchOutside) {
  const auto kernel = IsotropicGaborKernel<2>::with_unit_peak(1.0, 0.7);
  EXPECT_THROW(compact_kernel_at(kernel, 0.5 * kernel.radius_for_error(0.02), 0.02), std::invalid_argument);
}

TEST(CompactGaussian, HasTheRequestedErrorAgainstTheRadialGaussian) {
  for (int n = 1; n <= 4; ++n) {
    for (const double error : {0.5, 0.02, 1e-4}) {
      const double a = 1.7;
      const CompactKernel compact = compact_gaussian(a, n, error);
      const auto gaussian = [a](double r) { return std::exp(-kPi * a * a * r * r); };
      const double inside =
          ball_integral(compact, [&](double r) { return std::pow(gaussian(r) - compact.value(r), 2); });
      const double whole = std::pow(std::numbers::sqrt2 * a, -n);
      const double tail = whole * regularized_gamma_q(0.5 * n, 2.0 * kPi * std::pow(a * compact.radius(), 2));
      EXPECT_NEAR(std::sqrt((inside + tail) / whole) / error, 1.0, 1e-5) << n << "D, error " << error;
    }
  }
}

TEST(CompactKernel, ValueAndThreeDerivativesVanishAtTheRadius) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    const double radius = compact.radius();
    // At a distance of s radii from the end the kernel is (2 s)^4 P(-1/2), but for degree^2 s and for the
    // rounding of t P.
    constexpr double kNear = 1e-6;
    const double r = radius * (1.0 - kNear);
    const double half = radius * (1.0 - 0.5 * kNear);
    EXPECT_NEAR(compact.value(r) / compact.value(half), 16.0, 0.2);
    EXPECT_NEAR(compact.derivative(r) / compact.derivative(half), 8.0, 0.1);
    EXPECT_EQ(compact.value(radius), 0.0);
    EXPECT_EQ(compact.derivative(radius), 0.0);
    EXPECT_EQ(compact.value(radius * 1.5), 0.0);
    EXPECT_EQ(compact.derivative(radius * 1.5), 0.0);
  });
}

TEST(CompactKernel, DerivativeAgreesWithDifferences) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    // Fourth-order differences. A wave of F cycles per unit leaves an error of (2 pi F h)^4 / 30 of the
    // slope.
    const double h = 1e-3 / std::max(kernel.frequency(), 1.0 / compact.radius());
    for (const double share : {0.05, 0.31, 0.5, 0.77, 0.95}) {
      const double r = share * compact.radius();
      const double slope = (8.0 * (compact.value(r + h) - compact.value(r - h)) -
                            (compact.value(r + 2.0 * h) - compact.value(r - 2.0 * h))) /
                           (12.0 * h);
      EXPECT_NEAR(compact.derivative(r) * h, slope * h, 1e-9) << Dim << ' ' << share;
    }
  });
}

TEST(CompactKernel, EnergyIsWhatTheErrorLeaves) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    // The defining property of a least-squares fit. In the narrowest band P reaches 1e5 where t vanishes, and
    // the rounding of its coefficients shows as 1e-10 of the energy.
    EXPECT_NEAR(compact.energy() / (kernel.energy() * (1.0 - setting.error * setting.error)), 1.0, 1e-9);
    const double overlap =
        ball_integral(compact, [&](double r) { return kernel.value(r) * compact.value(r); });
    EXPECT_NEAR(overlap / compact.energy(), 1.0, 1e-9);
  });
}

TEST(CompactKernel, MomentsAgreeWithQuadrature) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    const double second = ball_integral(compact, [&](double r) { return std::pow(compact.value(r), 2); });
    const double fourth = ball_integral(compact, [&](double r) { return std::pow(compact.value(r), 4); });
    EXPECT_NEAR(compact.energy() / second, 1.0, 1e-12);
    EXPECT_NEAR(compact.fourth_moment() / fourth, 1.0, 1e-12);
  });
}

TEST(CompactKernel, BothFormsOfThePolynomialAreTheSame) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    ASSERT_EQ(compact.power_coefficients().size(), static_cast<std::size_t>(compact.degree()) + 1);
    if (!compact.well_conditioned()) return;
    for (const double share : {0.0, 0.3, 0.6, 0.9}) {
      const double t = 1.0 - share * share;
      double horner = 0.0;
      for (int k = compact.degree(); k >= 0; --k) {
        horner = horner * (t - 0.5) + compact.power_coefficients()[static_cast<std::size_t>(k)];
      }
      EXPECT_NEAR(std::pow(t, 4) * horner, compact.value(share * compact.radius()), 1e-10);
    }
  });
}

TEST(CompactKernel, HornerInSinglePrecisionIsAccurateWhereItSaysSo) {
  int tried = 0;
  for_each_kernel([&tried]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    if (!compact.well_conditioned()) return;
    ++tried;
    const double squared_noise = ball_integral(compact, [&](double r) {
      const float t = static_cast<float>(1.0 - std::pow(r / compact.radius(), 2));
      float horner = 0.0f;
      for (int k = compact.degree(); k >= 0; --k) {
        horner = horner * (t - 0.5f) +
                 static_cast<float>(compact.power_coefficients()[static_cast<std::size_t>(k)]);
      }
      return std::pow(static_cast<double>(t * t * t * t * horner) - compact.value(r), 2);
    });
    // A tenth more, for the rounding differs from node to node.
    EXPECT_LT(std::sqrt(squared_noise / compact.energy()), 1.1 * std::min(3e-5, 0.01 * setting.error)) << Dim;
  });
  EXPECT_GT(tried, 20);  // all bands of half an octave or more, but for the smallest errors
}

TEST(CompactKernel, SpectrumIsCloseToTheKernelsAndHasItsEnergy) {
  for (const double error : {0.02, 0.2}) {
    const auto kernel = kernel_of<3>({1.0, error, 1.0});
    const CompactKernel compact = compact_kernel(kernel, error);
    const auto difference = [&](double f) {
      return std::pow(compact.spectrum(f) - kernel.spectrum(f), 2) * 4.0 * kPi * f * f;
    };
    // Parseval: the spectrum's relative error is the kernel's, less what lies beyond 40 F0. The fitted kernel
    // is t^4 at the radius, so its spectrum falls as f^-6 and the rest as the ninth power of the limit.
    const double measured = std::sqrt(integrate(difference, 0.0, 40.0, 80) / kernel.energy());
    EXPECT_NEAR(measured / error, 1.0, 1e-3);
  }
}

TEST(CompactKernel, SpectrumAtZeroIsTheIntegral) {
  for_each_kernel([]<int Dim>(const IsotropicGaborKernel<Dim>& kernel, const Setting& setting) {
    const CompactKernel compact = compact_kernel(kernel, setting.error);
    const double integral = ball_integral(compact, [&](double r) { return compact.value(r); });
    const double scale = ball_integral(compact, [&](double r) { return std::abs(compact.value(r)); });
    EXPECT_NEAR(compact.spectrum(0.0), integral, 1e-12 * scale);
  });
}

TEST(CompactKernel, ScalesWithTheFrequency) {
  const CompactKernel unit = compact_kernel(kernel_of<3>({1.0, 0.02, 1.0}), 0.02);
  const CompactKernel large = compact_kernel(kernel_of<3>({1.0, 0.02, 1e-6}), 0.02);
  EXPECT_EQ(unit.degree(), large.degree());
  EXPECT_NEAR(large.radius() * 1e-6 / unit.radius(), 1.0, 1e-9);
  EXPECT_NEAR(large.value(0.3 * large.radius()), unit.value(0.3 * unit.radius()), 1e-9);
}

TEST(CompactKernel, IsNoLargerThanTheOneFoundByExhaustiveSearch) {
  // Bandwidth 1 octave, error 2 %, in 1 to 4 dimensions: a radius and degree found on a grid of both, rounded
  // up.
  const double a = gaussian_parameter(1.0, 1.0);
  const auto cost = [a](const CompactKernel& compact) {
    return ((compact.degree() + 1) / 2 * 2 + 5) * std::pow(a * compact.radius(), compact.dimensions());
  };
  EXPECT_LE(cost(compact_kernel(kernel_of<1>({1.0, 0.02, 1.0}), 0.02)), 11 * 1.119);
  EXPECT_LE(cost(compact_kernel(kernel_of<2>({1.0, 0.02, 1.0}), 0.02)), 9 * std::pow(1.010, 2));
  EXPECT_LE(cost(compact_kernel(kernel_of<3>({1.0, 0.02, 1.0}), 0.02)), 9 * std::pow(1.045, 3));
  EXPECT_LE(cost(compact_kernel(kernel_of<4>({1.0, 0.02, 1.0}), 0.02)), 9 * std::pow(1.090, 4));
}

TEST(CompactKernel, NeedsAnErrorInRange) {
  const auto kernel = kernel_of<2>({1.0, 0.02, 1.0});
  EXPECT_THROW(compact_kernel(kernel, 0.0), std::invalid_argument);
  EXPECT_THROW(compact_kernel(kernel, 1.0), std::invalid_argument);
  EXPECT_THROW(compact_kernel(kernel, std::nan("")), std::invalid_argument);
  EXPECT_THROW(compact_envelope(0.0, 3, 0.02), std::invalid_argument);
}

TEST(CompactEnvelope, ProductOverTheAxesHasTheRequestedError) {
  for (int dimensions = 1; dimensions <= 4; ++dimensions) {
    for (const double error : {0.3, 0.02, 1e-3}) {
      constexpr double kA = 2.5;
      const CompactKernel envelope = compact_envelope(kA, dimensions, error);
      const auto gaussian = [](double d) { return std::exp(-kPi * kA * kA * d * d); };
      const double energy = 1.0 / (std::numbers::sqrt2 * kA);
      const double own = ball_integral(envelope, [&](double d) { return std::pow(envelope.value(d), 2); });
      const double overlap =
          ball_integral(envelope, [&](double d) { return envelope.value(d) * gaussian(d); });
      const double squared_error =
          (std::pow(energy, dimensions) - 2.0 * std::pow(overlap, dimensions) + std::pow(own, dimensions)) /
          std::pow(energy, dimensions);
      EXPECT_NEAR(std::sqrt(squared_error) / error, 1.0, 1e-6) << dimensions << ' ' << error;
      EXPECT_EQ(envelope.dimensions(), 1);
      EXPECT_NEAR(1.0 - std::pow(1.0 - std::pow(envelope.relative_error(), 2), dimensions), error * error,
                  1e-9 * error);
    }
  }
}

}  // namespace
}  // namespace solidnoise::compact_kernel_test
