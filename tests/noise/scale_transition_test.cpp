#include "solidnoise/noise/point/scale_transition.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"

namespace solidnoise::scale_transition_test {
namespace {

TEST(ScaleTransition, PowerWeightsKeepTheVariance) {
  for (int n = 1; n <= 4; ++n) {
    for (double alpha = 0.0; alpha < 1.0; alpha += 0.01) {
      const ScaleWeights weights = scale_weights(ScaleTransition::power, n, alpha);
      // A dozen operations in double precision.
      EXPECT_NEAR(scale_variance(weights, n, alpha), 1.0, 1e-12);
    }
  }
}

TEST(ScaleTransition, WeightsEndWhereTheNextLevelBegins) {
  for (const ScaleTransition transition : {ScaleTransition::power, ScaleTransition::paper}) {
    for (int n = 1; n <= 4; ++n) {
      const ScaleWeights first = scale_weights(transition, n, 0.0);
      EXPECT_EQ(first.fine, 1.0);
      EXPECT_EQ(first.coarse, 0.0);
      const ScaleWeights last = scale_weights(transition, n, 1.0);
      EXPECT_NEAR(last.fine, 0.0, 1e-12);
      EXPECT_NEAR(last.coarse, 1.0, 1e-12);
    }
  }
}

TEST(ScaleTransition, PaperWeightsKeepTheNumberOfImpulsesAndLoseVariance) {
  // Equations 25 and 26 are for two dimensions. Used as amplitudes they leave ((1 - alpha)^2 + 4 alpha^2) /
  // (1 + alpha)^2 of the variance: half of it at alpha = 1/3.
  constexpr double kAlphas[] = {0.2, 1.0 / 3.0, 0.5, 0.8};
  constexpr double kVariances[] = {0.5556, 0.5, 0.5556, 0.8025};
  for (int i = 0; i < 4; ++i) {
    const double alpha = kAlphas[i];
    const ScaleWeights weights = scale_weights(ScaleTransition::paper, 2, alpha);
    EXPECT_NEAR(weights.fine, (1.0 - alpha) / std::pow(1.0 + alpha, 2), 1e-15);
    EXPECT_NEAR(weights.coarse, 4.0 * alpha / std::pow(1.0 + alpha, 2), 1e-15);
    EXPECT_NEAR(scale_variance(weights, 2, alpha), kVariances[i], 5e-5);  // as printed, to four digits
  }
  // In three dimensions, the same.
  constexpr double kVariances3[] = {0.5556, 0.5625, 0.6667, 0.8848};
  for (int i = 0; i < 4; ++i) {
    const ScaleWeights weights = scale_weights(ScaleTransition::paper, 3, kAlphas[i]);
    const double growth = std::pow(1.0 + kAlphas[i], 3);
    EXPECT_NEAR(weights.fine * growth + weights.coarse * growth / 8.0, 1.0, 1e-12);
    EXPECT_NEAR(scale_variance(weights, 3, kAlphas[i]), kVariances3[i], 5e-5);
  }
}

TEST(ScaleFade, MomentsAreItsIntegrals) {
  for (int n = 2; n <= 4; ++n) {
    const ScaleFade fade(n);
    // Piecewise polynomials of degree 12 at the most in each of 3 pieces, whose ends are multiples of 1/32.
    const auto moment = [&](int power) {
      return integrate([&](double y) { return std::pow(fade(y), power); }, 0.0, 1.0, 64);
    };
    EXPECT_NEAR(fade.second_moment, moment(2), 1e-12);
    EXPECT_NEAR(fade.fourth_moment, moment(4), 1e-12);
    EXPECT_EQ(fade(std::exp2(-n)), 0.0);
    EXPECT_EQ(fade(1.0), 0.0);
    EXPECT_EQ(fade(0.7), 1.0);
  }
}

TEST(ScaleFade, NeedsFewMoreImpulsesThanAStationaryNoise) {
  // The share 1 - 2^-n of the density is ever made.
  constexpr double kMost[] = {1.35, 1.25, 1.2};
  for (int n = 2; n <= 4; ++n) {
    EXPECT_LT((1.0 - std::exp2(-n)) * ScaleFade(n).impulses_per_effective_one, kMost[n - 2]);
  }
}

}  // namespace
}  // namespace solidnoise::scale_transition_test
