#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "support/paths.h"
#include "tools/expect_whole_or_nothing.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::failure_test {
namespace {

using namespace std::chrono_literals;

// Large enough to take seconds to make and to write.
const std::vector<std::string> kLongRun{"--raw", "--dim", "320", "--codec", "none", "--out", "x.vdb"};

TEST(Interrupt, WhileMakingLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    RunningTool tool(in_build("tools/vdbnoise"), kLongRun, {.folder = folder.path()});
    tool.wait_until_it_catches(signal);
    std::this_thread::sleep_for(100ms);  // into the making of the volume
    tool.send(signal);
    const ToolResult result = tool.wait();
    EXPECT_EQ(result.status, 128 + signal) << result.err;
    EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
    EXPECT_TRUE(folder.names().empty()) << *folder.names().begin();
  }
}

TEST(Interrupt, WhileWritingLeavesNothing) {
  const TemporaryFolder folder;
  RunningTool tool(in_build("tools/vdbnoise"), kLongRun, {.folder = folder.path()});
  ASSERT_TRUE(tool.wait_until_it_writes(folder.path()));
  ASSERT_TRUE(folder.names().empty()) << "the file must not have a name before it is whole";
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
  EXPECT_TRUE(folder.names().empty()) << *folder.names().begin();
}

// Commands that read or measure for long before they write. Each is let run for a while, then stopped.
TEST(Interrupt, EndsWithinASecondWhateverIsDone) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const std::string torus = in_source("meshes/torus.obj");
  ASSERT_EQ(run_vdbnoise({"surface", torus, "--dim", "300", "--band", "0.2", "--out", "band.vdb", "--quiet"},
                         in_folder)
                .status,
            0);
  ASSERT_EQ(run_vdbnoise({"--raw", "--frequency", "1", "--dim", "192", "--shard", "1/2", "--codec", "none",
                          "--out", "part.vdb", "--quiet"},
                         in_folder)
                .status,
            0);
  const std::set<std::string> before = folder.names();
  struct Run {
    std::chrono::milliseconds before_signal;
    std::vector<std::string> arguments;
  };
  const std::vector<std::string> displace{"--on",      "band.vdb", "--displace", "0.1",
                                          "--octaves", "4",        "--out",      "x.vdb"};
  const std::vector<Run> runs{
      {0ms, displace},
      {100ms, displace},
      {400ms, displace},
      {30ms, {"--on", "part.vdb", "--combine", "add", "--octaves", "4", "--out", "x.vdb"}},
      {0ms, {"merge", "part.vdb", "part.vdb", "--out", "x.vdb"}},
      {200ms, {"surface", torus, "--dim", "900", "--band", "0.2", "--max-memory", "64G", "--out", "x.vdb"}},
      {300ms, {"--dim", "200", "--preview", "x.png"}},
      {10ms, {"slice", "band.vdb", "--resolution", "4000", "--out", "x.png"}},
  };
  for (const Run& run : runs) {
    RunningTool tool(in_build("tools/vdbnoise"), run.arguments, in_folder);
    tool.wait_until_it_catches(SIGINT);
    std::this_thread::sleep_for(run.before_signal);
    const double before_end = tool.work();
    tool.send(SIGINT);
    const ToolResult result = tool.wait();
    EXPECT_LT(result.work - before_end, 1.0 * std::thread::hardware_concurrency()) << run.arguments[0];
    EXPECT_EQ(result.status, 128 + SIGINT) << run.arguments[0] << ": " << result.err;
    EXPECT_NE(result.err.find("vdbnoise: interrupted"), std::string::npos) << result.err;
    EXPECT_EQ(folder.names(), before);
  }
}

TEST(FullDisk, IsReportedAndLeavesNothing) {
  const TemporaryFolder folder;
  const ToolResult result = run_vdbnoise({"--raw", "--dim", "64", "--out", "x.vdb"},
                                         {.folder = folder.path(), .file_size_limit = 100000});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("x.vdb"), std::string::npos) << result.err;
  EXPECT_TRUE(folder.names().empty()) << *folder.names().begin();
}

TEST(FullDisk, KeepsTheFileThatWasThere) {
  const TemporaryFolder folder;
  folder.write("x.vdb", "precious");
  const ToolResult result = run_vdbnoise({"--raw", "--dim", "64", "--force", "--out", "x.vdb"},
                                         {.folder = folder.path(), .file_size_limit = 100000});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(folder.read("x.vdb"), "precious");
  EXPECT_EQ(folder.names(), std::set<std::string>{"x.vdb"});
}

TEST(FullDisk, OfARecipeOrAPreviewLeavesNothing) {
  const TemporaryFolder folder;
  const RunOptions options{.folder = folder.path(), .file_size_limit = 64};
  const ToolResult recipe =
      run_vdbnoise({"--quiet", "--raw", "--dim", "8", "--write-recipe", "x.json"}, options);
  EXPECT_EQ(recipe.status, 1);
  EXPECT_NE(recipe.err.find("x.json"), std::string::npos) << recipe.err;
  const ToolResult preview =
      run_vdbnoise({"--quiet", "--dim", "16", "--octaves", "1", "--preview", "x.png"}, options);
  EXPECT_EQ(preview.status, 1);
  EXPECT_NE(preview.err.find("x.png"), std::string::npos) << preview.err;
  EXPECT_TRUE(folder.names().empty()) << *folder.names().begin();
}

TEST(VdbnoiseFaults, LeaveAllOutputsOrNone) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"--quiet", "--preset", "smoke",          "--dim", "16",
                                     "--out",   "x.vdb",    "--write-recipe", "x.json"};
  const auto run = [&](const RunOptions& options) { return run_vdbnoise(arguments, options); };
  arguments.push_back("--force");
  expect_whole_or_nothing(run, folder, {{"x.vdb", "old"}, {"x.json", "old as well"}});
  arguments.pop_back();
  for (const char* name : {"x.vdb", "x.json"}) std::filesystem::remove(folder / name);
  arguments.insert(arguments.end(), {"--preview", "x.png"});
  expect_whole_or_nothing(run, folder);
}

TEST(VdbnoiseFaults, OfOtherCommandsLeaveTheOutputOrNone) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const std::string torus = in_source("meshes/torus.obj");
  for (const char* part : {"1/2", "2/2"}) {
    ASSERT_EQ(run_vdbnoise({"--quiet", "--raw", "--dim", "16", "--shard", part, "--out",
                            std::string("part") + part[0] + ".vdb"},
                           in_folder)
                  .status,
              0);
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"merge", "part1.vdb", "part2.vdb", "--quiet", "--out", "x.vdb"},
        {"surface", torus, "--dim", "24", "--quiet", "--out", "x.vdb"},
        {"slice", "part1.vdb", "--quiet", "--resolution", "16", "--out", "x.png"}}) {
    SCOPED_TRACE(arguments[0]);
    expect_whole_or_nothing([&](const RunOptions& options) { return run_vdbnoise(arguments, options); },
                            folder);
    std::filesystem::remove(folder / arguments.back());
  }
}

TEST(FullDisk, OfTheStandardOutputIsReported) {
  const ToolResult result =
      run_vdbnoise({"--raw", "--dim", "32", "--out", "-"}, {.standard_output = "/dev/full"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace solidnoise::failure_test
