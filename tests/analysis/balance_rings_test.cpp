#include "solidnoise/analysis/exemplar/balance_rings.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace solidnoise::balance_rings_test {
namespace {

ExemplarChannels grey(double variance, double trend) {
  ExemplarChannels channels;
  channels.directions = {{1.0}};
  channels.axes = {Vec<3>(1.0)};
  channels.variances = {variance};
  channels.trends = {trend};
  return channels;
}

// Rings of 1, .5 and .5, of a variance of 3.
TEST(BalanceRings, TrendsAreOfTheLowestRingAndTheRestIsOfAll) {
  const std::vector<std::vector<double>> cross{{1.0}, {0.5}, {0.5}};
  const auto expect_rings = [&](double trend, const std::vector<double>& expected) {
    const std::vector<double> rings = balance_rings(cross, grey(3.0, trend)).front();
    for (std::size_t r = 0; r < 3; ++r) EXPECT_NEAR(rings[r], expected[r], 1e-12) << trend;
  };
  expect_rings(1.0, {2.0, 0.5, 0.5});
  expect_rings(4.0, {2.0, 0.5, 0.5});
  expect_rings(0.0, {1.5, 0.75, 0.75});
  expect_rings(0.5, {1.75, 0.625, 0.625});
}

// Colours that independent channels along these axes can have.
TEST(BalanceRings, FindsThePowersThatColorsWereMadeOf) {
  ExemplarChannels channels;
  channels.axes = {Vec<3>(0.6, 0.64, 0.48), Vec<3>(0.8, -0.6, 0.0), Vec<3>(0.0, 0.28, 0.96)};
  for (const Vec<3>& direction : channel_directions({channels.axes[0], channels.axes[1], channels.axes[2]})) {
    channels.directions.push_back({direction.x, direction.y, direction.z});
  }
  const std::vector<std::vector<double>> made{{3.0, 0.5, 0.01}, {0.4, 0.6, 0.05}, {0.2, 0.01, 0.3}};
  channels.variances = {3.6, 1.11, 0.36};
  channels.trends.assign(9, 0.0);
  std::vector<std::vector<double>> cross(3, std::vector<double>(9));
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 9; ++i) {
        cross[r][i] += made[r][k] * channels.axes[k][static_cast<int>(i / 3)] *
                       channels.axes[k][static_cast<int>(i % 3)];
      }
    }
  }
  const std::vector<std::vector<double>> found = balance_rings(cross, channels);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k][r] / made[r][k], 1.0, 0.01) << r << ' ' << k;
  }
}

}  // namespace
}  // namespace solidnoise::balance_rings_test
