#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise::bandwidth_test {
namespace {

TEST(Bandwidth, IsWhereTheGaussianFallsToHalf) {
  for (const double octaves : {0.05, 0.5, 1.0, 4.0}) {
    const double a = gaussian_parameter(3.0, octaves);
    const double upper = 3.0 * 2.0 * std::exp2(octaves) / (std::exp2(octaves) + 1.0);
    const double lower = upper / std::exp2(octaves);
    EXPECT_NEAR(upper + lower, 6.0, 1e-12);
    EXPECT_NEAR(std::exp(-std::numbers::pi * std::pow((upper - 3.0) / a, 2)), 0.5, 1e-12);
    EXPECT_NEAR(std::exp(-std::numbers::pi * std::pow((lower - 3.0) / a, 2)), 0.5, 1e-12);
  }
}

TEST(Bandwidth, OctavesAndGaussianParameterAreInverse) {
  for (const double octaves : {0.05, 0.5, 1.0, 4.0, 20.0}) {
    EXPECT_NEAR(bandwidth_in_octaves(8.0, gaussian_parameter(8.0, octaves)) / octaves, 1.0, 1e-9);
  }
}

TEST(Bandwidth, OfOneOctaveIsThePapers) {
  // The setting of the 2009 and 2011 papers: F0 = 0.0625, a = 0.0443528 to the digits given.
  EXPECT_NEAR(gaussian_parameter(0.0625, 1.0), 0.0443528, 5e-8);
}

TEST(Bandwidth, IsUnlimitedWhenTheBandReachesZero) {
  EXPECT_TRUE(std::isinf(bandwidth_in_octaves(1.0, 3.0)));
}

}  // namespace
}  // namespace solidnoise::bandwidth_test
