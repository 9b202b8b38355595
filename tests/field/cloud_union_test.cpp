#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/field/cloud_puffs.h"

namespace solidnoise::cloud_union_test {
namespace {

float distance_at(const PuffUnion& shape, const Vec<3>& p) {
  const std::array<float, 3> q{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  float distance = 0.0f;
  shape.evaluate({std::span(&q[0], 1), std::span(&q[1], 1), std::span(&q[2], 1)}, {&distance, 1});
  return distance;
}

Vec<3> random_point(RandomStream& random) {
  const double x = 4.0 * random.next_unit() - 2.0;
  const double y = 3.0 * random.next_unit() - 1.0;
  const double z = 4.0 * random.next_unit() - 2.0;
  return {x, y, z};
}

constexpr double kFloatError = 1e-6;  // distances of a few units in floats

TEST(PuffUnion, IsTheDistanceToASinglePuff) {
  const PuffUnion ball({{{0.5, 0.0, 0.0}, 0.25}}, 0.1);
  EXPECT_NEAR(distance_at(ball, {1.5, 0.0, 0.0}), 0.75, kFloatError);
  EXPECT_NEAR(distance_at(ball, {0.5, 0.0, 0.0}), -0.25, kFloatError);
}

TEST(PuffUnion, RoundsWherePuffsMeet) {
  const PuffUnion pair({{{-0.5, 0.0, 0.0}, 0.5}, {{0.5, 0.0, 0.0}, 0.5}}, 0.1);
  // Both distances are equal, so that w = 1 twice: the union grows by k log 2.
  EXPECT_NEAR(distance_at(pair, {0.0, 0.0, 0.0}), -0.1 * std::log(2.0), kFloatError);
  // Far from the other puff it does not matter at all.
  EXPECT_NEAR(distance_at(pair, {-1.0, 0.0, 0.0}), 0.0, kFloatError);
}

TEST(PuffUnion, LeavingOutFarPuffsChangesNoBit) {
  const PuffUnion all(pile_puffs({}), 0.05);
  RandomStream random(7);
  std::size_t left_out = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec<3> lower = random_point(random);
    const Box<3> box{lower, lower + 0.2};
    const PuffUnion some = all.within(box);
    left_out += all.puffs().size() - some.puffs().size();
    const Vec<3> p = lower + 0.2 * Vec<3>(random.next_unit());
    EXPECT_EQ(distance_at(some, p), distance_at(all, p));
  }
  EXPECT_GT(left_out, 500u);  // else the test shows nothing
}

TEST(PuffUnion, DistanceIsNeverBelowItsBound) {
  const PuffUnion all(pile_puffs({}), 0.05);
  RandomStream random(8);
  for (int i = 0; i < 500; ++i) {
    const Vec<3> lower = random_point(random);
    const Box<3> box{lower, lower + 0.3};
    const Vec<3> p = lower + 0.3 * Vec<3>(random.next_unit());
    EXPECT_GE(distance_at(all, p), all.lower_bound(box) - kFloatError);
  }
}

}  // namespace
}  // namespace solidnoise::cloud_union_test
