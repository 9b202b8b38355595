#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/volume_cost.h"
#include "tools/expect_estimate.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::parts_test {
namespace {

void run_well(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST(Parts, ShardsMergeToTheWholeToTheLastBit) {
  const std::vector<std::vector<std::string>> cases{
      {"--dim", "96", "--quiet"},
      {"--preset", "marble", "--dim", "64", "--half", "--quiet"},
      {"--raw", "--shape", "sphere", "--dim", "70", "--range", "unit", "--quiet"},
      {"--raw", "--normalize", "--dim", "48", "--quiet"},
  };
  for (std::vector<std::string> arguments : cases) {
    const TemporaryFolder folder;
    arguments.insert(arguments.end(), {"--out", "whole.vdb"});
    run_well(arguments, folder);
    for (const char* shard : {"1", "2", "3", "4"}) {
      arguments.back() = std::string("part") + shard + ".vdb";
      std::vector<std::string> part = arguments;
      part.insert(part.end(), {"--shard", std::string(shard) + "/4", "--threads", shard});
      run_well(part, folder);
    }
    run_well({"merge", "part3.vdb", "part1.vdb", "part4.vdb", "part2.vdb", "--out", "merged.vdb", "--preview",
              "merged.png", "--quiet"},
             folder);
    expect_same_grid(folder.file("merged.vdb"), folder.file("whole.vdb"));
    EXPECT_EQ(folder.names().count("merged.png"), 1u);
  }
}

TEST(Parts, MergingIsHeldAgainstItsLimits) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes memory of its own";
#endif
  const TemporaryFolder folder;
  for (const char* const shard : {"1", "2"}) {
    run_well({"--raw", "--noise", "kensler", "--dim", "256", "--shard", std::string(shard) + "/2", "--out",
              std::string("part") + shard + ".vdb", "--quiet"},
             folder);
  }
  const auto merge = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"merge", "part1.vdb", "part2.vdb", "--out", "whole.vdb", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_vdbnoise(arguments, {.folder = folder.path()});
  };
  const ToolResult large = merge({"--max-memory", "60M"});
  EXPECT_EQ(large.status, 1);
  EXPECT_NE(large.err.find("merging may need"), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("--max-memory allows 60.0 MiB"), std::string::npos) << large.err;
  const ToolResult slow = merge({"--max-time", "0.01"});
  EXPECT_EQ(slow.status, 1);
  EXPECT_NE(slow.err.find("--max-time allows 0.01"), std::string::npos) << slow.err;
  EXPECT_EQ(folder.count(), 2u);

  const std::vector<std::filesystem::path> files{folder.file("part1.vdb"), folder.file("part2.vdb")};
  expect_peak(merge_cost(files, Making::streamed, Target::file).bytes, merge({}), "merge");
  expect_peak(merge_cost(files, Making::in_memory, Target::picture).bytes,
              merge({"--force", "--preview", "x.png"}), "merge --preview");
}

TEST(Parts, RegionsMergeToTheWholeToTheLastBit) {
  const TemporaryFolder folder;
  const std::vector<std::string> recipe{"--raw", "--dim", "50", "--box", "-1",     "-1",
                                        "-1",    "1",     "1",  "1",     "--quiet"};
  const auto make = [&](const std::string& out, const std::vector<std::string>& region) {
    std::vector<std::string> arguments = recipe;
    arguments.insert(arguments.end(), {"--out", out});
    arguments.insert(arguments.end(), region.begin(), region.end());
    run_well(arguments, folder);
  };
  make("whole.vdb", {});
  make("left.vdb", {"--region", "-2", "-2", "-2", "0.1", "2", "2"});
  make("right1.vdb", {"--region", "0.1", "-2", "-2", "2", "2", "2", "--shard", "1/2"});
  make("right2.vdb", {"--region", "0.1", "-2", "-2", "2", "2", "2", "--shard", "2/2"});
  run_well({"merge", "left.vdb", "right1.vdb", "right2.vdb", "--out", "merged.vdb", "--quiet"}, folder);
  expect_same_grid(folder.file("merged.vdb"), folder.file("whole.vdb"));

  const ToolResult result =
      run_vdbnoise({"merge", "left.vdb", "right2.vdb", "--out", "missing.vdb"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("parts are missing"), std::string::npos) << result.err;
  EXPECT_EQ(folder.names().count("missing.vdb"), 0u);
}

// A volume that would not fit in the memory does, part by part.
TEST(Parts, NeedLessMemoryThanTheWhole) {
  const std::vector<std::string> recipe{"--raw", "--dim", "128", "--max-memory", "65M", "--quiet"};
  const TemporaryFolder folder;
  std::vector<std::string> whole = recipe;
  whole.insert(whole.end(), {"--out", "whole.vdb"});
  const ToolResult result = run_vdbnoise(whole, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("--max-memory allows 65.0 MiB"), std::string::npos) << result.err;
  std::vector<std::string> part = recipe;
  part.insert(part.end(), {"--out", "part.vdb", "--shard", "2/8"});
  run_well(part, folder);
}

TEST(Parts, AreDescribedAsParts) {
  const auto memory = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--raw", "--dim", "128", "--describe"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolResult result = run_vdbnoise(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return parse_json(result.out)["grid"]["memory_at_most_bytes"].get<double>();
  };
  EXPECT_LT(memory({"--shard", "2/8"}), 0.3 * memory({}));
}

TEST(Vdbnoise, RefusesBeforeWorkWhatTakesTooLong) {
  const TemporaryFolder folder;
  const ToolResult result = run_vdbnoise(
      {"--raw", "--dim", "2048", "--exact", "--max-memory", "999G", "--max-time", "0.5", "--out", "x.vdb"},
      {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("--max-time allows 0.5"), std::string::npos) << result.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Vdbnoise, MakesTheSameFileAgain) {
  const TemporaryFolder folder;
  for (const char* out : {"a.vdb", "b.vdb"}) run_well({"--dim", "24", "--quiet", "--out", out}, folder);
  EXPECT_EQ(file_digest(folder.file("a.vdb")), file_digest(folder.file("b.vdb")));
}

TEST(Vdbnoise, WarnsOfAnEmptyVolume) {
  const TemporaryFolder folder;
  const ToolResult result =
      run_vdbnoise({"--dim", "16", "--frequency", "0.01", "--out", "x.vdb"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: the volume is empty"), std::string::npos) << result.err;
}

TEST(Vdbnoise, RefusesDensitiesThatAreBeyondHalfFloats) {
  const TemporaryFolder folder;
  const ToolResult result = run_vdbnoise({"--dim", "16", "--density", "1e6", "--half", "--out", "x.vdb"},
                                         {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("values that are not finite as 16-bit floats"), std::string::npos) << result.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Parts, WrongUsageIsRefused) {
  const TemporaryFolder folder;
  folder.write("garbage.vdb", "this is no volume");
  struct Refusal {
    int status;
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Refusal> refusals{
      {2, {"--shard", "4/3", "--out", "x.vdb"}, "--shard is 4/3; it must be K/N with K from 1 to N"},
      {2, {"--shard", "0/3", "--out", "x.vdb"}, "--shard is 0/3"},
      {2, {"--shard", "3", "--out", "x.vdb"}, "--shard is 3; it must be which of how many, such as 3/8"},
      {2, {"--shard", "1/x", "--out", "x.vdb"}, "--shard is x"},
      {2,
       {"--region", "0", "0", "0", "1", "0", "1", "--out", "x.vdb"},
       "--region reaches from 0 to 0 on axis y"},
      {2, {"merge", "--out", "x.vdb"}, "FILE"},
      {2, {"merge", "garbage.vdb"}, "--out is missing"},
      {2, {"merge", "garbage.vdb", "--out", "x.obj"}, "--out is x.obj; it must end in .vdb"},
      {1, {"merge", "garbage.vdb", "--out", "x.vdb"}, "garbage.vdb: is not a .vdb"},
      {1, {"merge", "nowhere.vdb", "--out", "x.vdb"}, "nowhere.vdb: cannot be read"},
      {1, {"merge", "nowhere.vdb", "--out", "garbage.vdb"}, "garbage.vdb exists; --force replaces it"},
  };
  for (const Refusal& refusal : refusals) {
    const ToolResult result = run_vdbnoise(refusal.arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, refusal.status);
    EXPECT_NE(result.err.find(refusal.says), std::string::npos) << result.err;
    EXPECT_EQ(folder.names(), std::set<std::string>{"garbage.vdb"});
  }
}

}  // namespace
}  // namespace solidnoise::parts_test
