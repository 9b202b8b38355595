#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/digest.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/volume.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::stream_parts_test {
namespace {

constexpr char kCreator[] = "merge test";

class StreamParts : public testing::Test {
 protected:
  std::vector<std::filesystem::path> write_shards(const VolumeRecipe& recipe, int shards) {
    std::vector<std::filesystem::path> paths;
    for (int shard = 1; shard <= shards; ++shard) {
      paths.insert(paths.begin(), folder_ / (std::to_string(shard) + ".vdb"));
      const VolumePart part{.shard = shard, .shards = shards};
      VdbWriteOptions write{.existing = Existing::replace, .frame = 7, .fps = 24.0};
      write_volume(paths.front(), make_volume(recipe, plan_volume(recipe, part), kCreator), write);
    }
    return paths;
  }

  // That what is merged into a file is the file of what is merged in memory, which is that of the whole.
  void expect_same_file(const VolumeRecipe& recipe, int shards = 5) {
    const std::vector<std::filesystem::path> parts = write_shards(recipe, shards);
    VdbWriteOptions write{
        .codec = recipe.codec, .existing = Existing::replace, .creator = kCreator, .frame = 7, .fps = 24.0};
    const Volume whole = make_volume(recipe, plan_volume(recipe), kCreator);
    write_volume(folder_ / "whole.vdb", whole, write);
    ASSERT_TRUE(may_stream_parts(parts));
    const MergedVolume merged = merge_parts_to_file(parts, folder_ / "merged.vdb",
                                                    {.existing = Existing::replace, .creator = kCreator});
    EXPECT_EQ(file_digest(folder_ / "merged.vdb"), file_digest(folder_ / "whole.vdb"));
    ASSERT_EQ(merged.volume.grids.size(), whole.grids.size());
    for (std::size_t i = 0; i < whole.grids.size(); ++i) {
      EXPECT_EQ(merged.volume.grids[i].moments.front().sigma(), whole.grids[i].moments.front().sigma());
    }
  }

  std::string refusal_of(const std::vector<std::filesystem::path>& parts) {
    const std::string message =
        message_of<std::runtime_error>([&] { merge_parts_to_file(parts, folder_ / "x.vdb", {}); });
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.vdb"));
    return message;
  }

  TemporaryFolder folder_;
};

VolumeRecipe raw_ball(int dim = 150) {
  VolumeRecipe recipe;
  recipe.shaping = RawShaping{};
  recipe.shape = SphereShape{};
  recipe.dim = dim;  // several nodes of 128^3 voxels, which parts share
  return recipe;
}

VolumeRecipe cloud() {
  VolumeRecipe recipe = raw_ball();
  recipe.shaping = CloudShaping{};
  recipe.noise.noise = GaborNoiseOptions{.frequency = 3.0};
  return recipe;
}

TEST_F(StreamParts, MakeTheFileOfTheWhole) {
  expect_same_file(raw_ball());
  expect_same_file(cloud());
}

TEST_F(StreamParts, MakeItWithEachCodecAndWidth) {
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    VolumeRecipe recipe = raw_ball(40);
    recipe.codec = codec;
    recipe.half = codec == Codec::zip;
    expect_same_file(recipe, 3);
  }
}

TEST_F(StreamParts, MakeItOfSeveralGridsAndVectors) {
  VolumeRecipe recipe = raw_ball(60);
  recipe.output = {Output::value, Output::gradient};
  expect_same_file(recipe, 3);
  recipe.output = {Output::curl};
  expect_same_file(recipe, 3);
}

TEST_F(StreamParts, MakeItOfDensitiesHoweverTheyAreScaledAndPruned) {
  VolumeRecipe recipe = cloud();
  recipe.density.peak = 3.0;
  recipe.prune = 0.3;
  expect_same_file(recipe);
  recipe.density = {};
  recipe.density.factor = 1.5;
  expect_same_file(recipe);
}

// Parts of which nothing is dense have no voxels.
TEST_F(StreamParts, MakeItOfManyPartsThatAreEmpty) {
  expect_same_file(cloud(), 70);
}

TEST_F(StreamParts, RefuseWhatIsMissingDoubleOrDamaged) {
  const std::vector<std::filesystem::path> parts = write_shards(raw_ball(50), 3);
  EXPECT_NE(refusal_of({parts[0], parts[2]}).find("parts are missing"), std::string::npos);
  EXPECT_NE(refusal_of({parts[0], parts[1], parts[2], parts[1]}).find("some are there twice"),
            std::string::npos);
  EXPECT_NE(refusal_of({}).find("there are no parts"), std::string::npos);
  std::filesystem::resize_file(parts[1], std::filesystem::file_size(parts[1]) / 2);
  EXPECT_NE(refusal_of(parts).find(parts[1].string() + ": "), std::string::npos);
}

// One that went through a pipe does not tell where its grids are.
TEST_F(StreamParts, SaysWhereItCannot) {
  const VolumeRecipe recipe = raw_ball(20);
  const Volume part = make_volume(recipe, plan_volume(recipe, {.shard = 1, .shards = 2}), kCreator);
  std::ofstream stream(folder_ / "piped.vdb", std::ios::binary);
  write_vdb(stream, grids_of(part), {});
  stream.close();
  EXPECT_FALSE(may_stream_parts({folder_ / "piped.vdb"}));
}

}  // namespace
}  // namespace solidnoise::stream_parts_test
