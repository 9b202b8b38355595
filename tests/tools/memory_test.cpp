#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/paths.h"
#include "tools/expect_estimate.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::memory_test {
namespace {

// Three bands of an exemplar's.
constexpr const char* kExemplar = R"({"solidnoise": 2, "exemplar": {"mean": [0, 0, 0], "channels": [
  {"axis": [1, 1, 1], "dimensions": 3, "isotropic": true, "groups": ["all"], "bands": [
    {"a": 0.5, "components": [[0.2, 0, 0, 1, 0]]}, {"a": 0.2, "components": [[0.1, 0, 0, 1, 0]]},
    {"a": 0.1, "components": [[0.05, 0, 0, 1, 0]]}]}]}})";

// Runs a command in a folder where each of these files is once a command names it.
ToolResult run(const std::vector<std::string>& command) {
  static const std::map<std::string, std::vector<std::string>> kMadeBy{
      {"surface.vdb", {"surface", in_source("meshes/torus.obj"), "--dim", "128", "--band", "0.3"}},
      {"small.vdb", {"surface", in_source("meshes/torus.obj"), "--dim", "32"}},
      {"values.vdb", {"--raw", "--noise", "kensler", "--dim", "96"}},
      {"large.vdb", {"--raw", "--noise", "kensler", "--dim", "320"}},
  };
  static const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  if (folder.count() == 0) folder.write("exemplar.json", kExemplar);
  for (const std::string& word : command) {
    const auto made = kMadeBy.find(word);
    if (made == kMadeBy.end() || std::filesystem::exists(folder / word)) continue;
    std::vector<std::string> making = made->second;
    making.insert(making.end(), {"--quiet", "--out", word});
    run_vdbnoise(making, in_folder);
  }
  return run_vdbnoise(command, in_folder);
}

class EstimatedMemory : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(EstimatedMemory, IsWhatAVolumeTakes) {
  expect_estimate(run, GetParam(), {"--force", "--out", "x.vdb"});
}

INSTANTIATE_TEST_SUITE_P(
    Vdbnoise, EstimatedMemory,
    testing::Values(
        std::vector<std::string>{"--preset", "cumulus", "--dim", "128"},
        std::vector<std::string>{"--preset", "marble", "--dim", "192"},
        std::vector<std::string>{"--preset", "velocity", "--dim", "144"},
        std::vector<std::string>{"--raw", "--dim", "256"},
        std::vector<std::string>{"--raw", "--dim", "448", "--max-memory", "450M"},
        std::vector<std::string>{"--raw", "--octaves", "5", "--dim", "128"},
        std::vector<std::string>{"--raw", "--octaves", "5", "--dim", "128", "--band-limit"},
        std::vector<std::string>{"--raw", "--dim", "256", "--exact", "--shard", "1/4"},
        std::vector<std::string>{"--raw", "--impulses", "20000", "--frequency", "10", "--dim", "16"},
        std::vector<std::string>{"--raw", "--impulses", "12000", "--dim", "16"},
        std::vector<std::string>{"--raw", "--dims", "4", "--frequency", "4", "--dim", "160"},
        std::vector<std::string>{"--raw", "--noise", "exemplar.json", "--frequency", "8", "--dim", "160"},
        std::vector<std::string>{"--preset", "cumulus", "--dim", "64", "--preview", "x.png"},
        std::vector<std::string>{"--preset", "fire", "--dim", "128", "--preview", "x.png"},
        std::vector<std::string>{"--preset", "marble", "--dim", "128", "--preview", "x.png"},
        std::vector<std::string>{"--raw", "--shape", "large.vdb"},
        std::vector<std::string>{"--raw", "--shape", "large.vdb", "--shard", "1/4"},
        std::vector<std::string>{"--on", "values.vdb", "--combine", "add"},
        std::vector<std::string>{"--on", "surface.vdb", "--raw", "--displace", "0.02"},
        std::vector<std::string>{"--on", "surface.vdb", "--raw", "--displace", "0.1"},
        std::vector<std::string>{"--on", "surface.vdb", "--raw", "--octaves", "5", "--gain", "0.9",
                                 "--displace", "0.05"},
        std::vector<std::string>{"--on", "surface.vdb", "--raw", "--range", "signed", "--displace", "0.5"},
        std::vector<std::string>{"--on", "surface.vdb", "--raw", "--range", "unit", "--displace", "0.2"},
        std::vector<std::string>{"--on", "small.vdb", "--raw", "--displace", "2"},
        std::vector<std::string>{"--preset", "velocity", "--dim", "96", "--boundary", "surface.vdb"}));

// So many impulses are held for a brick at a time, and a brick of many kernels has many of them.
TEST(EstimatedMemory, OfDenseImpulsesIsHeldAgainstWhatMayBeTaken) {
  const ToolResult refused =
      run({"--dim", "32", "--impulses", "1e5", "--max-memory", "100M", "--out", "dense.vdb"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("--max-memory"), std::string::npos) << refused.err;
}

// Voxels that are many waves apart need the impulses around each, not those in between.
TEST(EstimatedMemory, OfSparseVoxelsIsThatOfTheirImpulses) {
  const ToolResult made = run({"--preset", "raw", "--frequency", "1000", "--octaves", "1", "--dim", "32",
                               "--max-memory", "1G", "--quiet", "--out", "sparse.vdb"});
  EXPECT_EQ(made.status, 0) << made.err;
}

TEST(EstimatedMemory, IsWhatOtherCommandsTake) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"analyze", "values.vdb"},
           {"analyze", "large.vdb", "--plot", "x.png", "--force"},
           {"surface", in_source("meshes/torus.obj"), "--dim", "384", "--out", "s.vdb", "--force"},
           {"surface", in_source("meshes/wyrm.ply"), "--dim", "100", "--out", "s.vdb", "--force"},
           {"surface", in_source("meshes/torus.obj"), "--band", "0.2", "--out", "s.vdb", "--force"},
           {"slice", "--out", "x.png", "--force"},
           {"slice", "--resolution", "2048", "--noise", "kensler", "--out", "x.exr", "--force"},
           {"slice", "--resolution", "2048", "--noise", "kensler", "--color", "--out", "x.exr", "--force"},
           {"slice", "--resolution", "2048", "--noise", "kensler", "--ramp", "viridis", "--out", "x.png",
            "--force"},
           {"slice", "--resolution", "2048", "--dims", "2", "--spectrum", "x.png", "--force"},
           {"slice", "--dims", "1", "--out", "x.csv", "--force"},
           {"slice", "large.vdb", "--out", "x.png", "--force"},
           {"slice", "--preset", "cumulus", "--resolution", "1024", "--out", "x.png", "--force"},
           {"slice", "--preset", "fire", "--grid", "vel", "--out", "x.png", "--force"},
       }) {
    expect_limits(run, command);
  }
}

// Of clouds most of a box is empty, and more of the boxes of a sky.
TEST(EstimatedMemory, IsWhatASkyTakes) {
  expect_estimate(run, {"sky", "--kinds", "3", "--voxel", "20", "--out", "sky.vdb"}, {"--force"});
  expect_estimate(run, {"sky", "--count", "30", "--seed", "3", "--voxel", "25", "--out", "sky.vdb"},
                  {"--force"});
  expect_estimate(run, {"sky", "--count", "4", "--kinds", "1", "--voxel", "7", "--out", "sky.usda"},
                  {"--force"});
}

}  // namespace
}  // namespace solidnoise::memory_test
