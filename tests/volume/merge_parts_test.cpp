#include "solidnoise/volume/merge_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/random.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "support/temporary_folder.h"

namespace solidnoise::merge_parts_test {
namespace {

constexpr char kCreator[] = "merge test";

class MergeParts : public testing::Test {
 protected:
  std::filesystem::path write_part(const VolumeRecipe& recipe, const VolumePart& part) {
    const Volume volume = make_volume(recipe, plan_volume(recipe, part), kCreator);
    const std::filesystem::path path = folder_ / (std::to_string(written_++) + ".vdb");
    openvdb::GridCPtrVec grids;
    for (const MeasuredGrid& measured : volume.grids) grids.push_back(measured.grid);
    write_vdb(path, grids, {.frame = 7, .fps = 24.0});
    return path;
  }

  std::vector<std::filesystem::path> write_shards(const VolumeRecipe& recipe, int shards) {
    std::vector<std::filesystem::path> paths;
    for (int shard = shards; shard >= 1; --shard) {
      paths.push_back(write_part(recipe, {.shard = shard, .shards = shards}));
    }
    return paths;
  }

 private:
  TemporaryFolder folder_;
  int written_ = 0;
};

void expect_same(const Volume& merged, const Volume& whole) {
  ASSERT_EQ(merged.grids.size(), whole.grids.size());
  const auto& a = dynamic_cast<const openvdb::FloatGrid&>(*merged.grids[0].grid);
  const auto& b = dynamic_cast<const openvdb::FloatGrid&>(*whole.grids[0].grid);
  EXPECT_TRUE(a.tree().hasSameTopology(b.tree()));
  std::uint64_t differ = 0;
  for (auto voxel = b.cbeginValueOn(); voxel; ++voxel)
    differ += a.tree().getValue(voxel.getCoord()) != *voxel;
  EXPECT_EQ(differ, 0u);
  EXPECT_EQ(static_cast<const openvdb::MetaMap&>(a), static_cast<const openvdb::MetaMap&>(b));
  EXPECT_EQ(a.transform(), b.transform());
  EXPECT_EQ(merged.grids[0].moments[0].mean(), whole.grids[0].moments[0].mean());
  EXPECT_EQ(merged.grids[0].moments[0].sigma(), whole.grids[0].moments[0].sigma());
}

VolumeRecipe cloud() {
  VolumeRecipe recipe;
  recipe.shaping = CloudShaping{};
  recipe.noise.noise = GaborNoiseOptions{.frequency = 3.0};
  recipe.noise.fractal.octaves = 2;
  recipe.dim = 100;
  return recipe;
}

VolumeRecipe raw_ball() {
  VolumeRecipe recipe;
  recipe.shaping = RawShaping{};
  recipe.shape = SphereShape{};
  recipe.half = true;
  recipe.dim = 90;
  return recipe;
}

// The scale of a cloud's density depends on all of it.
TEST_F(MergeParts, ShardsMakeTheWholeCloudToTheLastBit) {
  const VolumeRecipe recipe = cloud();
  const MergedVolume merged = merge_parts(write_shards(recipe, 5), kCreator);
  EXPECT_EQ(to_json(merged.recipe), to_json(recipe));
  EXPECT_EQ(merged.frame, 7);
  EXPECT_EQ(merged.fps, 24.0);
  expect_same(merged.volume, make_volume(recipe, plan_volume(recipe), kCreator));
}

TEST_F(MergeParts, RegionsMakeTheWholeToTheLastBit) {
  const VolumeRecipe recipe = raw_ball();
  const std::vector<std::filesystem::path> parts = {
      write_part(recipe, {.region = Box<3>{{-9.0, -9.0, -9.0}, {0.13, 9.0, 9.0}}}),
      write_part(recipe, {.region = Box<3>{{0.13, -9.0, -9.0}, {9.0, 0.3, 9.0}}}),
      write_part(recipe, {.region = Box<3>{{0.13, 0.3, -9.0}, {9.0, 9.0, 9.0}}}),
  };
  expect_same(merge_parts(parts, kCreator).volume, make_volume(recipe, plan_volume(recipe), kCreator));
}

void expect_refused(const std::vector<std::filesystem::path>& parts, const std::string& part_of_message) {
  try {
    merge_parts(parts, kCreator);
    ADD_FAILURE() << "not refused: " << part_of_message;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
  }
}

TEST_F(MergeParts, RefusesMissingDoubleAndForeignParts) {
  const VolumeRecipe recipe = raw_ball();
  std::vector<std::filesystem::path> parts = write_shards(recipe, 3);
  expect_refused({parts[0], parts[2]}, "parts are missing");
  expect_refused({parts[0], parts[1], parts[2], parts[1]}, parts[1].string() + ": overlaps");
  VolumeRecipe other = recipe;
  std::get<GaborNoiseOptions>(other.noise.noise).seed = 1;
  const std::filesystem::path foreign = write_part(other, {.shard = 1, .shards = 3});
  expect_refused({parts[0], parts[1], foreign}, foreign.string() + ": is not of the same volume as ");
  const std::filesystem::path whole = write_part(recipe, {});
  expect_refused({whole}, whole.string() + ": is not a part of a volume");
}

// A part of which nothing is dense has no leaves in its file: given twice, it must not pass for another one.
TEST_F(MergeParts, RefusesAnEmptyPartInThePlaceOfAnother) {
  // Corners of the box, which a cloud is not in.
  constexpr double kFaces[] = {-9.0, -0.5, 0.0, 0.5, 9.0};
  std::vector<std::filesystem::path> parts;
  for (int i = 0; i < 64; ++i) {
    const auto face = [&](int axis, int next) { return kFaces[(i >> 2 * axis & 3) + next]; };
    parts.push_back(write_part(cloud(), {.region = Box<3>{{face(0, 0), face(1, 0), face(2, 0)},
                                                          {face(0, 1), face(1, 1), face(2, 1)}}}));
  }
  std::map<std::string, std::vector<std::size_t>> empty;  // by the number of leaves before those are dropped
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const GridSummary grid = read_vdb_summary(parts[i]).grids[0];
    if (grid.active_voxels == 0) empty[grid.metadata.at("solidnoise:part_leaves")].push_back(i);
  }
  const auto alike =
      std::find_if(empty.begin(), empty.end(), [](const auto& same) { return same.second.size() > 1; });
  ASSERT_NE(alike, empty.end());
  parts[alike->second[0]] = parts[alike->second[1]];
  expect_refused(parts, "are not the parts of the volume");
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Whatever bit of a part is wrong: either it is refused, or it is one that the whole takes nothing from.
TEST_F(MergeParts, NoWrongBitOfAPartGetsIntoTheWhole) {
  VolumeRecipe recipe = cloud();
  recipe.dim = 40;
  const std::vector<std::filesystem::path> parts = write_shards(recipe, 2);
  const Volume whole = make_volume(recipe, plan_volume(recipe), kCreator);
  const std::string bytes = bytes_of(parts[0]);
  constexpr int kFlips = 300;
  int refused = 0;
  RandomStream random(1);
  for (int i = 0; i < kFlips; ++i) {
    std::string damaged = bytes;
    const std::uint64_t bit = random.next() % (8 * bytes.size());
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    std::ofstream(parts[0], std::ios::binary) << damaged;
    try {
      const MergedVolume merged = merge_parts(parts, kCreator);
      expect_same(merged.volume, whole);
    } catch (const std::runtime_error&) {
      ++refused;
    }
    ASSERT_FALSE(HasFailure()) << "bit " << bit;
  }
  // Nine tenths of the file are compressed values, and nearly all of these bits count.
  EXPECT_GT(refused, kFlips / 2);
}

TEST_F(MergeParts, RefusesAVoxelThatWasAdded) {
  const std::vector<std::filesystem::path> parts = write_shards(raw_ball(), 2);
  const VdbFile file = read_grids(parts[0]);
  openvdb::gridPtrCast<openvdb::FloatGrid>(file.grids[0])
      ->tree()
      .setValue(openvdb::Coord(100000, 0, 0), 1.0f);
  write_vdb(parts[0], {file.grids[0]}, {.existing = Existing::replace, .frame = 7, .fps = 24.0});
  expect_refused(parts, parts[0].string() + ": is damaged");
}

}  // namespace
}  // namespace solidnoise::merge_parts_test
