#include "solidnoise/volume/stream_volume.h"

#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "solidnoise/volume/volume_recipe.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::stream_volume_test {
namespace {

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

const VdbWriteOptions kWrite{.existing = Existing::replace, .creator = "tests 1"};
constexpr std::size_t kOneNode = 1;  // bytes of a slab: no more than a node of 128^3 voxels

// Nodes of 128^3 voxels meet in the middle.
VolumeRecipe recipe_of(int dim = 48) {
  VolumeRecipe recipe;
  recipe.dim = dim;
  recipe.shaping = RawShaping{};
  recipe.shape = EllipsoidShape{};
  return recipe;
}

// The same volume is written from memory and slab by slab.
void expect_same_file(const VolumeRecipe& recipe) {
  const TemporaryFolder folder;
  const VolumePlan plan = plan_volume(recipe);
  const Volume whole = make_volume(recipe, plan, kWrite.creator);
  write_volume(folder / "whole.vdb", whole, kWrite);
  const Volume streamed = stream_volume(folder / "streamed.vdb", recipe, plan, kWrite, kOneNode);
  EXPECT_TRUE(read_bytes(folder / "whole.vdb") == read_bytes(folder / "streamed.vdb"));
  ASSERT_EQ(streamed.grids.size(), whole.grids.size());
  for (std::size_t i = 0; i < whole.grids.size(); ++i) {
    const Moments& moments = whole.grids[i].moments.front();
    EXPECT_EQ(streamed.grids[i].moments.front().count(), moments.count());
    EXPECT_EQ(streamed.grids[i].moments.front().sigma(), moments.sigma());
    EXPECT_EQ(streamed.grids[i].grid->evalActiveVoxelDim(), whole.grids[i].grid->evalActiveVoxelDim());
  }
}

TEST(StreamVolume, WritesTheSameFileOfRawNoise) {
  expect_same_file(recipe_of());
}

TEST(StreamVolume, WritesTheSameFileOfAVolumeOfOneNode) {
  VolumeRecipe recipe = recipe_of(20);
  recipe.box = {Vec<3>(0.1), Vec<3>(1.0)};
  recipe.shape = BoxShape{};
  expect_same_file(recipe);
}

TEST(StreamVolume, WritesTheSameFileWithEachCodec) {
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    for (const bool half : {false, true}) {
      VolumeRecipe recipe = recipe_of(24);
      recipe.codec = codec;
      recipe.half = half;
      expect_same_file(recipe);
    }
  }
}

TEST(StreamVolume, WritesTheSameFileOfVectors) {
  VolumeRecipe recipe = recipe_of(32);
  recipe.output = {Output::curl};
  expect_same_file(recipe);
}

TEST(StreamVolume, WritesTheSameFileOfTwoGrids) {
  VolumeRecipe recipe = recipe_of(32);
  recipe.output = {Output::value, Output::gradient};
  expect_same_file(recipe);
}

// What is active is known by the values.
TEST(StreamVolume, WritesTheSameFileOfDensities) {
  VolumeRecipe recipe = recipe_of();
  recipe.shaping = CloudShaping{};
  expect_same_file(recipe);
  recipe.density.peak = 3.0;
  expect_same_file(recipe);
  recipe.density.factor = 1.5;
  expect_same_file(recipe);
}

TEST(StreamVolume, WritesTheSameFileOfDensitiesWhoseLeastAreLeftOut) {
  VolumeRecipe recipe = recipe_of();
  recipe.shaping = CloudShaping{};
  recipe.prune = 0.3;
  expect_same_file(recipe);
}

TEST(StreamVolume, CountsHowOftenVoxelsAreEvaluated) {
  VolumeRecipe recipe = recipe_of();
  EXPECT_EQ(passes_of_stream(recipe), 1);
  recipe.output = {Output::value, Output::gradient};
  EXPECT_EQ(passes_of_stream(recipe), 2);
  recipe = recipe_of();
  recipe.shaping = CloudShaping{};
  EXPECT_EQ(passes_of_stream(recipe), 2);
  recipe.prune = 0.1;
  EXPECT_EQ(passes_of_stream(recipe), 3);
}

TEST(StreamVolume, LeavesNothingBehindWhereTheDiskIsFull) {
  const TemporaryFolder folder;
  const VolumeRecipe recipe = recipe_of();
  const VolumePlan plan = plan_volume(recipe);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string refusal = message_of<std::runtime_error>(
      [&] { stream_volume(folder / "x.vdb", recipe, plan, kWrite, kOneNode); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(refusal.find("x.vdb: writing failed: "), std::string::npos) << refusal;
  EXPECT_EQ(folder.count(), 0u);
}

TEST(StreamVolume, StopsWhenAskedInTheMiddleAndLeavesNothingBehind) {
  class StopInTheMiddle final : public Progress {
   public:
    void advance(std::uint64_t done, std::uint64_t total) override { stop_ = stop_ || 2 * done > total; }
    bool cancelled() override { return stop_; }

   private:
    std::atomic<bool> stop_ = false;
  } stop;
  const TemporaryFolder folder;
  const VolumeRecipe recipe = recipe_of();
  VdbWriteOptions options = kWrite;
  options.progress = &stop;
  EXPECT_THROW(stream_volume(folder / "x.vdb", recipe, plan_volume(recipe), options, kOneNode), Cancelled);
  EXPECT_EQ(folder.count(), 0u);
}

TEST(StreamVolume, RefusesValuesThatAreNotFiniteAsTheyAreStored) {
  const TemporaryFolder folder;
  VolumeRecipe recipe = recipe_of(16);
  recipe.shaping = CloudShaping{};
  recipe.density.factor = 1e9;
  recipe.half = true;
  const std::string refusal = message_of<std::runtime_error>(
      [&] { stream_volume(folder / "x.vdb", recipe, plan_volume(recipe), kWrite, kOneNode); });
  EXPECT_NE(refusal.find("not finite as 16-bit floats"), std::string::npos) << refusal;
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::stream_volume_test
