#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"

namespace solidnoise::quadrature_test {
namespace {

TEST(Quadrature, GaussLegendreIsExactForPolynomialsOfItsDegree) {
  for (const int count : {1, 2, 5, 20, 300}) {
    const QuadratureRule rule = gauss_legendre(count);
    for (const int power : {0, 1, 2 * count - 2, 2 * count - 1}) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        sum += rule.weights[i] * std::pow(rule.nodes[i], power);
      }
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14) << count << ' ' << power;
    }
  }
}

TEST(Quadrature, GaussLegendreIsNotExactBeyondItsDegree) {
  const QuadratureRule rule = gauss_legendre(3);
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], 6);
  EXPECT_GT(std::abs(sum - 2.0 / 7.0), 1e-3);
}

TEST(Quadrature, TwoCyclesInAPanelAreIntegratedExactly) {
  constexpr double kCycle = 6.283185307179586;
  // 10 panels over 20.25 cycles of a cosine under a Gaussian, against the closed form on the whole line.
  const auto wave = [](double x) { return std::exp(-x * x) * std::cos(kCycle * 1.5 * x); };
  const double expected = std::sqrt(kCycle / 2.0) * std::exp(-std::pow(kCycle * 1.5, 2) / 4.0);
  EXPECT_NEAR(integrate(wave, -6.75, 6.75, 10), expected, 1e-13);
}

TEST(Bisection, FindsTheZeroOfRisingAndFallingFunctions) {
  EXPECT_NEAR(bisect([](double x) { return x * x - 2.0; }, 0.0, 2.0), std::sqrt(2.0), 4e-15);
  EXPECT_NEAR(bisect([](double x) { return std::cos(x); }, 0.0, 3.0), 1.5707963267948966, 6e-15);
}

}  // namespace
}  // namespace solidnoise::quadrature_test
