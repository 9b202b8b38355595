#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::layers_test {
namespace {

constexpr char kTree[] = R"({
  "solidnoise": 1,
  "noise": {"type": "gabor", "frequency": 3, "octaves": 2},
  "layers": [{"combine": "max", "warp": {"amount": 0.1}, "layers": [
    {"fold": "ridged"},
    {"noise": {"type": "gabor", "frequency": 2}, "histogram": "uniform", "ramp": [[0, -1], [1, 2]]}]}],
  "shaping": {"type": "remap", "threshold": -0.5, "edge": 0.4},
  "dim": 40
})";

void run_well(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST(Layers, AreTheSameFromAnyThreadsAndShards) {
  const TemporaryFolder folder;
  folder.write("tree.json", kTree);
  const std::vector<std::string> recipe{"--recipe", "tree.json", "--quiet", "--out"};
  const auto make = [&](const std::vector<std::string>& rest) {
    std::vector<std::string> arguments = recipe;
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    run_well(arguments, folder);
  };
  make({"whole.vdb", "--threads", "1"});
  make({"threads.vdb", "--threads", "3"});
  make({"part1.vdb", "--shard", "1/2"});
  make({"part2.vdb", "--shard", "2/2"});
  run_well({"merge", "part1.vdb", "part2.vdb", "--out", "merged.vdb", "--quiet"}, folder);
  expect_same_grid(folder.file("threads.vdb"), folder.file("whole.vdb"));
  expect_same_grid(folder.file("merged.vdb"), folder.file("whole.vdb"));
  run_well({"--recipe", "whole.vdb", "--quiet", "--out", "again.vdb"}, folder);
  expect_same_grid(folder.file("again.vdb"), folder.file("whole.vdb"));
}

TEST(Layers, FlagsMakeThoseOfARecipe) {
  const TemporaryFolder folder;
  const std::vector<std::string> flags{"--raw",   "--dim", "24",       "--fold",  "billow",
                                       "--warp",  "0.1",   "3",        "--quiet", "--histogram",
                                       "uniform", "--out", "flags.vdb"};
  std::vector<std::string> to_recipe = flags;
  to_recipe.insert(to_recipe.end(), {"--write-recipe", "flags.json"});
  run_well(to_recipe, folder);
  run_well({"--recipe", "flags.json", "--quiet", "--out", "recipe.vdb"}, folder);
  expect_same_grid(folder.file("recipe.vdb"), folder.file("flags.vdb"));
}

TEST(Layers, WhatHasNoEffectIsRefused) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const TemporaryFolder folder;
  folder.write("tree.json", kTree);
  folder.write("own.json", R"({"solidnoise": 1, "layers": [{"noise": {"type": "gabor"}}]})");
  folder.write("bad.json",
               R"({"solidnoise": 1, "layers": [{}, {"noise": {"type": "gabor", "bandwidth": -1}}]})");
  const std::set<std::string> before = folder.names();
  const std::vector<Case> cases{
      {{"--fold", "ridged"}, "--fold has no effect on a cloud; give --raw or another --preset too"},
      {{"--raw", "--fold", "wavy"}, "--fold is wavy; it must be one of none, ridged, billow, turbulence"},
      {{"--raw", "--warp", "-1"}, "--warp is -1; it must be between 0 and"},
      {{"--raw", "--warp", "1", "--output", "curl"},
       "--warp makes a layer, which has its value only; --output is curl"},
      {{"--raw", "--warp", "1", "0"}, "--warp is 0; it must be between 1e-12"},
      {{"--raw", "--histogram", "uniform", "--range", "unit"}, "--range unit is of 3 sigma"},
      {{"--raw", "--warp", "0.1", "--band-limit"}, "--band-limit is true; it must be false"},
      {{"--recipe", "tree.json", "--fold", "billow"}, "--fold has no effect where the recipe has layers"},
      {{"--recipe", "own.json", "--frequency", "3"}, "--frequency has no effect where each layer"},
      {{"--recipe", "bad.json"},
       "bad.json: line 1: layers[1].noise.bandwidth is -1; it must be between 0.05 and 4"},
  };
  for (const Case& of : cases) {
    std::vector<std::string> arguments = of.arguments;
    arguments.insert(arguments.end(), {"--dim", "8", "--out", "x.vdb"});
    const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
    EXPECT_NE(result.status, 0);
    EXPECT_NE(result.err.find(of.says), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder.names(), before);
}

TEST(Layers, AreDescribedAndWarnOfTheirOwnPeriods) {
  const TemporaryFolder folder;
  std::string tree = kTree;
  tree.replace(tree.find("\"frequency\": 2}"), 14, "\"frequency\": 2, \"period\": [1.5444, 0, 0, 0]");
  folder.write("tree.json", tree);
  const ToolResult described =
      run_vdbnoise({"--recipe", "tree.json", "--describe"}, {.folder = folder.path()});
  EXPECT_EQ(described.status, 0) << described.err;
  const auto at = described.out.find("layer_noises");
  ASSERT_NE(at, std::string::npos) << described.out;
  EXPECT_NE(described.out.find("\"variance\"", at), std::string::npos);
  const ToolResult made =
      run_vdbnoise({"--recipe", "tree.json", "--out", "tree.vdb"}, {.folder = folder.path()});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("the period is 1.5444 along x"), std::string::npos) << made.err;
}

}  // namespace
}  // namespace solidnoise::layers_test
