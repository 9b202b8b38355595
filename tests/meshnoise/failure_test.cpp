#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "support/paths.h"
#include "tools/expect_whole_or_nothing.h"

namespace solidnoise::failure_test {
namespace {

using namespace std::chrono_literals;

const std::set<std::string> kInputOnly{"in.ply"};

// The noise takes minutes, in hundreds of batches.
TEST(MeshnoiseInterrupt, WhileBakingLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    write_sample(folder, "in.ply", sample_torus(40));
    RunningTool tool(in_build("tools/meshnoise"),
                     {"bake", "in.ply", "--out", "x.ply", "--preview", "x.png", "--frequency", "300",
                      "--impulses", "20000", "--error", "0.001", "--octaves", "8"},
                     {.folder = folder.path()});
    tool.wait_until_it_catches(signal);
    std::this_thread::sleep_for(200ms);  // into the noise
    tool.send(signal);
    const ToolResult result = tool.wait();
    EXPECT_EQ(result.status, 128 + signal) << result.err;
    EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
    EXPECT_EQ(folder.names(), kInputOnly);
  }
}

// A bake that has begun to write some 300000 vertices as text, which takes long.
RunningTool begin_to_write(const TemporaryFolder& folder) {
  write_sample(folder, "in.ply", sample_torus(44));
  RunningTool tool(in_build("tools/meshnoise"),
                   {"bake", "in.ply", "--out", "x.off", "--noise", "kensler", "--detail", "1", "--octaves",
                    "1", "--bias", "0", "--refine", "3"},
                   {.folder = folder.path()});
  EXPECT_TRUE(tool.wait_until_it_writes(folder.path()));
  return tool;
}

TEST(MeshnoiseInterrupt, WhileWritingLeavesNothing) {
  const TemporaryFolder folder;
  RunningTool tool = begin_to_write(folder);
  ASSERT_EQ(folder.names(), kInputOnly) << "the file must not have a name before it is whole";
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
  EXPECT_EQ(folder.names(), kInputOnly);
}

// Runs on a disk with room for `bytes` per file.
ToolResult run_on_full_disk(const TemporaryFolder& folder, long bytes,
                            const std::vector<std::string>& arguments) {
  return run_meshnoise(arguments, {.folder = folder.path(), .file_size_limit = bytes});
}

TEST(MeshnoiseFullDisk, IsReportedAndLeavesNothing) {
  for (const std::string command : {"bake", "curvature"}) {
    for (const std::string out : {"x.ply", "x.obj", "x.off", "x.om"}) {
      const TemporaryFolder folder;
      write_sample(folder, "in.ply", sample_torus());
      const ToolResult result = run_on_full_disk(folder, 2000, {command, "in.ply", "--out", out});
      EXPECT_EQ(result.status, 1);
      EXPECT_NE(result.err.find(out), std::string::npos) << result.err;
      EXPECT_EQ(folder.names(), kInputOnly);
    }
  }
}

TEST(MeshnoiseFullDisk, KeepsTheFileThatWasThere) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  const std::string before = folder.read("in.ply");
  const ToolResult result = run_on_full_disk(folder, 2000, {"bake", "in.ply", "--force", "--out", "in.ply"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(folder.read("in.ply") == before);
  EXPECT_EQ(folder.names(), kInputOnly);
}

TEST(MeshnoiseFullDisk, OfARecipeOrAPreviewLeavesNothing) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  const ToolResult recipe =
      run_on_full_disk(folder, 64, {"bake", "in.ply", "--quiet", "--write-recipe", "x.json"});
  EXPECT_EQ(recipe.status, 1);
  EXPECT_NE(recipe.err.find("x.json"), std::string::npos) << recipe.err;
  EXPECT_EQ(folder.names(), kInputOnly);
  if (!SOLIDNOISE_PREVIEWS) GTEST_SKIP() << "built without Embree";
  const ToolResult preview =
      run_on_full_disk(folder, 64, {"bake", "in.ply", "--quiet", "--preview", "x.png"});
  EXPECT_EQ(preview.status, 1);
  EXPECT_NE(preview.err.find("x.png"), std::string::npos) << preview.err;
  EXPECT_EQ(folder.names(), kInputOnly);
}

TEST(MeshnoiseFullDisk, OfTheStandardOutputIsReported) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  for (const std::string command : {"bake", "curvature"}) {
    const ToolResult result = run_meshnoise({command, "in.ply", "--out", "-"},
                                            {.folder = folder.path(), .standard_output = "/dev/full"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
  }
}

TEST(MeshnoiseFullDisk, OfTheStandardOutputIsReportedOfTextsToo) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"--version"},
                                                    {"bake", "--help"},
                                                    {"--list-presets"},
                                                    {"--schema"},
                                                    {"info", "in.ply"},
                                                    {"bake", "in.ply", "--describe"}}) {
    const ToolResult result =
        run_meshnoise(arguments, {.folder = folder.path(), .standard_output = "/dev/full"});
    EXPECT_EQ(result.status, 1) << arguments[0];
    EXPECT_EQ(result.err, "meshnoise: standard output: writing failed: No space left on device\n");
  }
}

TEST(MeshnoiseFaults, LeaveAllOutputsOrNone) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(6));
  std::vector<std::string> arguments{"bake",  "in.ply", "--quiet",        "--preset", "raw",
                                     "--out", "x.ply",  "--write-recipe", "x.json"};
  const auto run = [&](const RunOptions& options) { return run_meshnoise(arguments, options); };
  arguments.push_back("--force");
  expect_whole_or_nothing(run, folder, {{"x.ply", "old"}, {"x.json", "old as well"}});
  arguments.pop_back();
  for (const char* name : {"x.ply", "x.json"}) std::filesystem::remove(folder / name);
  if (SOLIDNOISE_PREVIEWS) arguments.insert(arguments.end(), {"--preview", "x.png", "--preview-size", "32"});
  expect_whole_or_nothing(run, folder);
}

TEST(MeshnoiseFaults, LeaveNothingWhereAllFilesHaveNames) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(6));
  const auto run = [&](const char* fault) {
    return run_meshnoise(
        {"bake", "in.ply", "--quiet", "--force", "--out", "x.ply", "--write-recipe", "x.json"},
        {.folder = folder.path(), .environment = failing_calls(fault)});
  };
  for (const bool is_there : {false, true}) {
    if (is_there) folder.write("x.ply", "old");
    const std::set<std::string> before = folder.names();
    EXPECT_EQ(run("open 1 fail").status, 0);
    EXPECT_EQ(folder.names(), (std::set<std::string>{"in.ply", "x.ply", "x.json"}));
    EXPECT_NE(folder.read("x.ply"), "old");
    std::filesystem::remove(folder / "x.json");
    if (!is_there) std::filesystem::remove(folder / "x.ply");
    EXPECT_EQ(folder.names(), before);
  }
}

TEST(MeshnoiseKilled, WhileWritingLeavesNothing) {
  const TemporaryFolder folder;
  RunningTool tool = begin_to_write(folder);
  tool.send(SIGKILL);
  EXPECT_EQ(tool.wait().signal, SIGKILL);
  EXPECT_EQ(folder.names(), kInputOnly);
}

// Damaged files end in a message, never in a signal. The damage is fixed: 12 cuts, 12 flipped bits.
TEST(MeshnoiseDamagedInput, IsRefusedOrRead) {
  for (const std::string format : {"ply", "obj", "off", "om"}) {
    const TemporaryFolder folder;
    write_sample(folder, "whole." + format, sample_torus(6));
    const std::string whole = folder.read("whole." + format);
    const std::string name = "damaged." + format;
    for (std::size_t i = 0; i < 12; ++i) {
      folder.write(name, whole.substr(0, whole.size() * i / 12));
      const ToolResult cut = run_meshnoise({"bake", name, "--out", "x.ply"}, {.folder = folder.path()});
      if (format != "obj" || i == 0) {  // other parts of an OBJ may be meshes
        EXPECT_EQ(cut.status, 1) << format << " cut at " << i << "/12: " << cut.err;
        EXPECT_NE(cut.err.find(name), std::string::npos) << cut.err;
      }
      EXPECT_EQ(cut.signal, 0) << format << " cut at " << i << "/12";

      std::string flipped = whole;
      flipped[whole.size() * (2 * i + 1) / 24] ^= static_cast<char>(1 << (i % 8));
      folder.write(name, flipped);
      const ToolResult flip =
          run_meshnoise({"bake", name, "--force", "--out", "x.ply"}, {.folder = folder.path()});
      EXPECT_EQ(flip.signal, 0) << format << " flipped at " << i << "/12";
      EXPECT_TRUE(flip.status == 0 || flip.err.find(name) != std::string::npos) << flip.err;
      std::filesystem::remove(folder.file("x.ply"));
    }
    EXPECT_EQ(folder.names(), (std::set<std::string>{"whole." + format, name}));
  }
}

}  // namespace
}  // namespace solidnoise::failure_test
