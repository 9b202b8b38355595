#include "solidnoise/core/special_functions.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"

namespace solidnoise::special_functions_test {
namespace {

constexpr double kPi = std::numbers::pi;

// The mean over directions by quadrature in the angle to e: weight sin^(n-2). Smooth, so exact to rounding.
template <typename Function>
double direction_mean(int n, const Function& of_cosine) {
  const auto weight = [n](double angle) { return std::pow(std::sin(angle), n - 2); };
  const auto product = [&](double angle) { return weight(angle) * of_cosine(std::cos(angle)); };
  return integrate(product, 0.0, kPi, 40) / integrate(weight, 0.0, kPi, 40);
}

TEST(SpecialFunctions, SphereAndBallAgreeWithTextbookValues) {
  EXPECT_DOUBLE_EQ(unit_sphere_area(1), 2.0);
  EXPECT_DOUBLE_EQ(unit_sphere_area(2), 2.0 * kPi);
  EXPECT_DOUBLE_EQ(unit_sphere_area(3), 4.0 * kPi);
  EXPECT_DOUBLE_EQ(unit_sphere_area(4), 2.0 * kPi * kPi);
  EXPECT_DOUBLE_EQ(unit_ball_volume(1), 2.0);
  EXPECT_DOUBLE_EQ(unit_ball_volume(2), kPi);
  EXPECT_DOUBLE_EQ(unit_ball_volume(3), 4.0 / 3.0 * kPi);
  EXPECT_DOUBLE_EQ(unit_ball_volume(4), kPi * kPi / 2.0);
}

TEST(SpecialFunctions, ScaledBesselIAgreesWithTabulatedValues) {
  // Abramowitz and Stegun, table 9.8.
  EXPECT_NEAR(bessel_i_scaled(0.0, 1.0), 0.465759607593640, 1e-15);
  EXPECT_NEAR(bessel_i_scaled(1.0, 1.0), 0.207910415349708, 1e-15);
}

TEST(SpecialFunctions, ScaledBesselIIsContinuousWhereTheSeriesChange) {
  // The power series below 30 and the asymptotic one above are independent; over 2e-12 the function changes
  // by 1e-12 / 30 of itself.
  for (const double order : {-0.5, 0.0, 0.5, 1.0, 2.0, 4.0}) {
    EXPECT_NEAR(bessel_i_scaled(order, 30.0 - 1e-12) / bessel_i_scaled(order, 30.0 + 1e-12), 1.0, 2e-13);
  }
}

TEST(SpecialFunctions, ScaledBesselIDoesNotOverflow) {
  // I_v(x) ~ exp(x) / sqrt(2 pi x) (1 - (4 v^2 - 1) / (8 x)).
  EXPECT_NEAR(bessel_i_scaled(1.0, 1e6) * std::sqrt(2.0 * kPi * 1e6), 1.0 - 3.0 / 8e6, 1e-12);
}

TEST(SpecialFunctions, MeanCosineIsTheMeanOverDirections) {
  for (int n = 2; n <= 8; ++n) {
    for (const double z : {0.0, 0.01, 0.7, 0.999, 1.001, 5.0, 60.0}) {
      const double expected = direction_mean(n, [z](double c) { return std::cos(z * c); });
      EXPECT_NEAR(mean_cosine(n, z), expected, 1e-14) << n << ' ' << z;
    }
  }
  EXPECT_DOUBLE_EQ(mean_cosine(1, 2.0), std::cos(2.0));
}

TEST(SpecialFunctions, MeanExponentialIsTheMeanOverDirections) {
  for (int n = 2; n <= 8; ++n) {
    for (const double z : {0.0, 0.01, 1.0, 10.0, 29.9, 30.1, 200.0}) {
      const double expected = direction_mean(n, [z](double c) { return std::exp(z * (c - 1.0)); });
      EXPECT_NEAR(mean_exponential_scaled(n, z) / expected, 1.0, 1e-12) << n << ' ' << z;
    }
  }
  EXPECT_DOUBLE_EQ(mean_exponential_scaled(1, 2.0), 0.5 * (1.0 + std::exp(-4.0)));
}

TEST(SpecialFunctions, IncompleteGammaAgreesWithElementaryForms) {
  for (const double x : {1e-6, 0.3, 1.0, 1.6, 5.0, 40.0, 300.0}) {
    EXPECT_NEAR(regularized_gamma_q(0.5, x) / std::erfc(std::sqrt(x)), 1.0, 1e-12) << x;
    EXPECT_NEAR(regularized_gamma_q(1.0, x) / std::exp(-x), 1.0, 1e-12) << x;
    EXPECT_NEAR(regularized_gamma_q(3.0, x) / (std::exp(-x) * (1.0 + x + x * x / 2.0)), 1.0, 1e-12) << x;
  }
  EXPECT_EQ(regularized_gamma_q(2.0, 0.0), 1.0);
}

}  // namespace
}  // namespace solidnoise::special_functions_test
