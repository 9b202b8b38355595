#include "solidnoise/volume/topology/volume_part.h"

#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/make_volume.h"

namespace solidnoise::volume_part_test {
namespace {

Topology ball() {
  return sphere_topology(GridFrame(0.1), {1.0, -2.0, 0.5}, 7.0);
}

// Adds the part to `joined`, and expects that none of its leaves was there.
void join(const Topology& part, openvdb::MaskTree& joined) {
  for (auto leaf = part.mask->cbeginLeaf(); leaf; ++leaf) {
    EXPECT_EQ(joined.probeConstLeaf(leaf->origin()), nullptr);
    joined.addLeaf(new openvdb::MaskTree::LeafNodeType(*leaf));
  }
}

void expect_same_voxels(const openvdb::MaskTree& joined, const openvdb::MaskTree& whole) {
  EXPECT_EQ(joined.leafCount(), whole.leafCount());
  EXPECT_EQ(joined.activeVoxelCount(), whole.activeVoxelCount());
  EXPECT_TRUE(joined.hasSameTopology(whole));
}

TEST(VolumePart, ShardsAreDisjointAndTogetherTheWhole) {
  const Topology whole = ball();
  for (const int shards : {2, 3, 7, 40}) {
    openvdb::MaskTree joined(false);
    for (int shard = 1; shard <= shards; ++shard) {
      join(take_part(whole, {.shard = shard, .shards = shards}), joined);
    }
    expect_same_voxels(joined, *whole.mask);
  }
}

// A shard has its equal part of the leaves up to the leaves of one block at either end.
TEST(VolumePart, ShardsAreAboutEqual) {
  const Topology whole = ball();
  constexpr std::uint64_t kLeavesOfABlock = 64;
  const std::uint64_t equal = whole.leaf_count() / 4;
  for (int shard = 1; shard <= 4; ++shard) {
    const std::uint64_t leaves = take_part(whole, {.shard = shard, .shards = 4}).leaf_count();
    EXPECT_GE(leaves + kLeavesOfABlock, equal);
    EXPECT_LE(leaves, equal + kLeavesOfABlock);
  }
}

// What is free counts next to nothing: the shards of what costs something are about equal, up to the leaves
// of one block at either end and a 64th of those that are free.
TEST(VolumePart, ShardsCostAboutTheSame) {
  const Topology whole = ball();
  const auto is_free = [](const openvdb::CoordBBox& voxels) { return voxels.min().x() >= 0; };
  std::vector<std::uint64_t> costs;
  openvdb::MaskTree joined(false);
  for (int shard = 1; shard <= 4; ++shard) {
    const Topology part = take_part(whole, {.shard = shard, .shards = 4}, is_free);
    join(part, joined);
    std::uint64_t cost = 0;
    for (auto leaf = part.mask->cbeginLeaf(); leaf; ++leaf)
      cost += is_free(leaf->getNodeBoundingBox()) ? 0 : 1;
    costs.push_back(cost);
  }
  expect_same_voxels(joined, *whole.mask);
  const std::uint64_t all = std::accumulate(costs.begin(), costs.end(), std::uint64_t{0});
  ASSERT_GT(all, 1000u);
  ASSERT_LT(all, whole.leaf_count() / 2);
  constexpr std::uint64_t kLeavesOfABlock = 64;
  const std::uint64_t slack = kLeavesOfABlock + whole.leaf_count() / 64;
  for (const std::uint64_t cost : costs) {
    EXPECT_LE(cost, all / 4 + slack);
    EXPECT_GE(cost + slack, all / 4);
  }
}

TEST(VolumePart, MoreShardsThanBlocksLeaveSomeEmpty) {
  const Topology whole = box_topology(GridFrame(1.0), {{0.0, 0.0, 0.0}, {4.0, 4.0, 4.0}});
  openvdb::MaskTree joined(false);
  for (int shard = 1; shard <= 5; ++shard) join(take_part(whole, {.shard = shard, .shards = 5}), joined);
  expect_same_voxels(joined, *whole.mask);
}

TEST(VolumePart, RegionsThatShareAFaceAreDisjointAndTogetherTheWhole) {
  const Topology whole = ball();
  openvdb::MaskTree joined(false);
  // Faces on leaves' first voxels, between voxels and off every voxel.
  const double faces[] = {-100.0, -4.8, 0.03, 0.8, 2.25, 100.0};
  for (int i = 0; i + 1 < 6; ++i) {
    const Box<3> region{{-100.0, faces[i], -100.0}, {100.0, faces[i + 1], 100.0}};
    join(take_part(whole, {.region = region, .shard = 1, .shards = 2}), joined);
    join(take_part(whole, {.region = region, .shard = 2, .shards = 2}), joined);
  }
  expect_same_voxels(joined, *whole.mask);
}

TEST(VolumePart, OfARegionTakesTheMemoryOfItsChannels) {
  const VolumePart part{.region = Box<3>{{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}}};
  VolumeRecipe recipe;
  recipe.dim = 256;
  recipe.shaping = RawShaping{};
  const auto memory = [&] {
    const VolumePlan whole = plan_volume(recipe);
    const std::uint64_t masks = whole.memory / 16;  // estimate_part_memory()
    return static_cast<double>(plan_volume(recipe, part).memory - masks);
  };
  const double one = memory();
  recipe.output = {Output::curl};
  EXPECT_NEAR(memory() / one, 3.0, 0.3);
}

TEST(VolumePart, RefusesWhatIsNoPart) {
  EXPECT_THROW((VolumePart{.shard = 0, .shards = 4}.validate()), std::invalid_argument);
  EXPECT_THROW((VolumePart{.shard = 5, .shards = 4}.validate()), std::invalid_argument);
  EXPECT_THROW((VolumePart{.shard = 1, .shards = 0}.validate()), std::invalid_argument);
  EXPECT_THROW((VolumePart{.region = Box<3>{{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}}}.validate()),
               std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::volume_part_test
