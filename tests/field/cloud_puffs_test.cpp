#include "solidnoise/field/cloud_puffs.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace solidnoise::cloud_puffs_test {
namespace {

const PuffPile kPile{.size = {2.0, 1.0, 1.5}, .count = 22, .lean = 0.25, .seed = 1};

bool same(const Puff& a, const Puff& b) {
  return a.centre == b.centre && a.radius == b.radius;
}

TEST(CloudPuffs, FillTheirBoxAndStayInIt) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    PuffPile pile = kPile;
    pile.seed = seed;
    Vec<3> low{std::numeric_limits<double>::infinity()};
    Vec<3> high = -low;
    for (const Puff& puff : pile_puffs(pile)) {
      low = glm::min(low, puff.centre - puff.radius);
      high = glm::max(high, puff.centre + puff.radius);
    }
    constexpr double kRounding = 1e-12;
    EXPECT_GE(low.x, -1.0 - kRounding);
    EXPECT_LE(high.x, 1.0 + kRounding);
    EXPECT_GE(low.z, -0.75 - kRounding);
    EXPECT_LE(high.z, 0.75 + kRounding);
    EXPECT_LE(high.y, 1.0 + kRounding);
    const double fullest = std::max({(high.x - low.x) / 2.0, high.y / 1.0, (high.z - low.z) / 1.5});
    EXPECT_NEAR(fullest, 1.0, kRounding);
  }
}

TEST(CloudPuffs, HangTogether) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    PuffPile pile = kPile;
    pile.seed = seed;
    pile.lean = 0.0;  // shearing moves puffs apart by a little
    const std::vector<Puff> puffs = pile_puffs(pile);
    std::vector<bool> reached(puffs.size());
    std::vector<std::size_t> open{0};
    reached[0] = true;
    while (!open.empty()) {
      const Puff from = puffs[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < puffs.size(); ++i) {
        if (reached[i] || glm::distance(puffs[i].centre, from.centre) > puffs[i].radius + from.radius)
          continue;
        reached[i] = true;
        open.push_back(i);
      }
    }
    EXPECT_EQ(std::count(reached.begin(), reached.end(), false), 0) << "seed " << seed;
  }
}

TEST(CloudPuffs, DependOnTheSeedAlone) {
  const std::vector<Puff> first = pile_puffs(kPile);
  const std::vector<Puff> again = pile_puffs(kPile);
  PuffPile other_pile = kPile;
  other_pile.seed = 2;
  const std::vector<Puff> other = pile_puffs(other_pile);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin(), again.end(), same));
  EXPECT_FALSE(std::equal(first.begin(), first.end(), other.begin(), other.end(), same));
}

}  // namespace
}  // namespace solidnoise::cloud_puffs_test
