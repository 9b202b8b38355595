#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::error_budget_test {
namespace {

// Noise of two octaves; voxels of 1/64 hold the first with ease, and the second just so that it can be
// interpolated.
const std::vector<std::string> kNoise{"--raw", "--noise", "gabor", "--frequency", "2.5",     "--octaves",
                                      "2",     "--box",   "0",     "0",           "0",       "1",
                                      "1",     "1",       "--dim", "64",          "--quiet", "--force"};

ToolResult run(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kNoise;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_vdbnoise(arguments);
}

nlohmann::json described_noise(const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = more;
  arguments.push_back("--describe");
  const ToolResult result = run(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out)["noise"];
}

openvdb::FloatGrid::Ptr make(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = more;
  arguments.insert(arguments.end(), {"--out", folder.file("noise.vdb")});
  const ToolResult result = run(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return read_float_grid(folder.file("noise.vdb"));
}

TEST(VdbnoiseError, IsDescribedInItsParts) {
  const nlohmann::json noise = described_noise();
  const double truncation = noise["error"]["truncation"];
  const double interpolation = noise["error"]["interpolation"];
  EXPECT_GT(interpolation, 0.0);
  EXPECT_NEAR(noise["error"]["total"], std::hypot(truncation, interpolation), 1e-9);
  EXPECT_LE(noise["error"]["total"], 0.02);
  ASSERT_EQ(noise["evaluation"].size(), 2u);
  EXPECT_GT(noise["evaluation"][0]["step_voxels"][0], 1);
}

TEST(VdbnoiseError, ASmallerOneIsKept) {
  const nlohmann::json noise = described_noise({"--error", "0.002"});
  EXPECT_LE(noise["error"]["total"], 0.002);
}

TEST(VdbnoiseError, ExactIsWithoutInterpolation) {
  const nlohmann::json noise = described_noise({"--exact"});
  EXPECT_EQ(noise["error"]["interpolation"], 0.0);
  EXPECT_GT(noise["error"]["truncation"], 0.0);
  EXPECT_EQ(noise["evaluation"], nlohmann::json::parse(R"(["direct", "direct"])"));
}

// What the two differ by is the error of interpolation, and twice what compact kernels have of frequencies
// beyond the band, which is less than their error.
TEST(VdbnoiseError, ExactDiffersByNoMoreThanTheError) {
  const TemporaryFolder folder;
  const auto quick = make(folder, {});
  const auto exact = make(folder, {"--exact"});
  ASSERT_TRUE(quick->tree().hasSameTopology(exact->tree()));
  double squares = 0.0;
  for (auto value = quick->cbeginValueOn(); value; ++value) {
    squares += std::pow(static_cast<double>(*value) - exact->tree().getValue(value.getCoord()), 2);
  }
  const double difference = std::sqrt(squares / static_cast<double>(quick->activeVoxelCount()));
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference, 1.5 * 0.02);
}

TEST(VdbnoiseError, ExactIsInTheRecipe) {
  const TemporaryFolder folder;
  const auto exact = make(folder, {"--exact"});
  const ToolResult again =
      run_vdbnoise({"--recipe", folder.file("noise.vdb"), "--out", folder.file("again.vdb"), "--quiet"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(same_values(*exact, *read_float_grid(folder.file("again.vdb"))));
  EXPECT_FALSE(same_values(*exact, *make(folder, {})));
}

// In groups of blocks of any size: a small part of the volume has the values of the whole.
TEST(VdbnoiseError, ValuesDoNotDependOnTheRegion) {
  const TemporaryFolder folder;
  const auto whole = make(folder, {});
  const auto part = make(folder, {"--region", "0.3", "0.2", "0.5", "0.6", "0.4", "0.9"});
  ASSERT_GT(part->activeVoxelCount(), 0u);
  for (auto value = part->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(*value, whole->tree().getValue(value.getCoord())) << value.getCoord();
  }
}

}  // namespace
}  // namespace solidnoise::error_budget_test
