#include "solidnoise/noise/point/scale_fade.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"

namespace solidnoise::scale_fade_test {
namespace {

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
}  // namespace solidnoise::scale_fade_test
