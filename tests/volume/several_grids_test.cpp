// Recipes of several grids: each is what a recipe of it alone makes, bit for bit.
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "support/temporary_folder.h"

namespace solidnoise::several_grids_test {
namespace {

constexpr char kRecipe[] = R"({
  "solidnoise": 2, "noise": {"type": "gabor-oriented", "frequency": 2, "octaves": 2, "seed": 7},
  "fields": {"body": {"layers": [{"place": "distance", "ramp": [[0, 1], [1, -1]]},
                                 {"fold": "billow", "stretch": [1, 2, 1], "weight": 0.5}],
                      "warp": {"amount": 0.05}}},
  "grids": [
    {"name": "density", "layers": [{"use": "body"}], "shaping": {"type": "remap", "threshold": 0.1}},
    {"name": "heat", "layers": [{"use": "body", "ramp": [[0, 0], [1, 2000]]}], "sparse": true},
    {"output": "curl", "noise": {"type": "gabor-oriented", "frequency": 1}, "drift": [0, 1.5, 0],
     "within": {"use": "body"}}
  ],
  "domain": {"dim": 36}
})";

Volume make(const VolumeRecipe& recipe, const VolumePart& part = {}) {
  return make_volume(recipe, plan_volume(recipe, part), "test");
}

template <typename Grid>
void expect_same(const openvdb::GridBase& a, const openvdb::GridBase& b) {
  const auto& one = dynamic_cast<const Grid&>(a);
  const auto& other = dynamic_cast<const Grid&>(b);
  EXPECT_EQ(one.getName(), other.getName());
  ASSERT_TRUE(one.tree().hasSameTopology(other.tree())) << one.getName();
  EXPECT_GT(one.activeVoxelCount(), 1000u);
  for (auto value = one.cbeginValueOn(); value; ++value) {
    ASSERT_EQ(*value, other.tree().getValue(value.getCoord())) << one.getName();
  }
}

void expect_same(const Volume& a, const Volume& b) {
  expect_same<openvdb::FloatGrid>(*a.grids.at(0).grid, *b.grids.at(0).grid);
  expect_same<openvdb::FloatGrid>(*a.grids.at(1).grid, *b.grids.at(1).grid);
  expect_same<openvdb::Vec3SGrid>(*a.grids.at(2).grid, *b.grids.at(2).grid);
}

// Alone nothing is shared, so that this also holds what shared fields keep against what they are.
TEST(SeveralGrids, AreThoseOfTheirOwnRecipes) {
  const VolumeRecipe recipe = volume_recipe_from_json(parse_json(kRecipe));
  Volume alone;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    Volume made = make(single);
    ASSERT_EQ(made.grids.size(), 1u);
    alone.grids.push_back(made.grids.front());
  }
  expect_same(make(recipe), alone);
}

TEST(SeveralGrids, DependOnNeitherThreadsNorParts) {
  const VolumeRecipe recipe = volume_recipe_from_json(parse_json(kRecipe));
  const Volume whole = make(recipe);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    expect_same(make(recipe), whole);
  }
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (int shard = 1; shard <= 2; ++shard) {
    const Volume part = make(recipe, {.shard = shard, .shards = 2});
    std::vector<openvdb::GridBase::ConstPtr> grids;
    for (const MeasuredGrid& measured : part.grids) grids.push_back(measured.grid);
    files.push_back(folder.file("part" + std::to_string(shard) + ".vdb"));
    write_vdb(files.back(), grids, {});
  }
  expect_same(merge_parts(files, "test").volume, whole);
}

// A file's grids are made again from the recipe that any of them carries.
TEST(SeveralGrids, CarryTheWholeRecipe) {
  const VolumeRecipe recipe = volume_recipe_from_json(parse_json(kRecipe));
  const Volume volume = make(recipe);
  for (const MeasuredGrid& measured : volume.grids) {
    const auto stored = measured.grid->getMetadata<openvdb::StringMetadata>("solidnoise:recipe");
    ASSERT_TRUE(stored);
    EXPECT_EQ(stored->value(), format_json(to_json(recipe)));
  }
}

TEST(SeveralGrids, MasksDropVoxelsAndDriftIsAdded) {
  VolumeRecipe recipe = volume_recipe_from_json(parse_json(kRecipe));
  recipe = recipes_of_grids(recipe).back();
  recipe.within = Layer{.place = Layer::Place::x, .ramp = {{0.5, 0.0}, {0.5001, 1.0}}};
  const Volume masked = make(recipe);
  VolumeRecipe still = recipe;
  still.drift = Vec<3>(0.0);
  const Volume without_drift = make(still);
  const auto& vel = dynamic_cast<const openvdb::Vec3SGrid&>(*masked.grids.front().grid);
  const auto& calm = dynamic_cast<const openvdb::Vec3SGrid&>(*without_drift.grids.front().grid);
  EXPECT_GT(vel.activeVoxelCount(), 1000u);
  for (auto value = vel.cbeginValueOn(); value; ++value) {
    EXPECT_GE(vel.indexToWorld(value.getCoord()).x(), 0.0);
    EXPECT_NEAR((*value)[1], calm.tree().getValue(value.getCoord())[1] + 1.5f, 1e-6);
  }
}

}  // namespace
}  // namespace solidnoise::several_grids_test
