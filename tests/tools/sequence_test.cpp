#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "support/paths.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::sequence_test {
namespace {

using namespace std::chrono_literals;

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::vector<std::string> kEvolving{"--raw", "--dim",    "12", "--frequency",
                                         "2",     "--evolve", "1",  "--quiet"};

TEST(Sequence, NamesGrowPastTheirDigitsAndStepsAreKept) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  for (const char* pattern : {"a.###.vdb", "b_%03d.vdb", "c%d.vdb"}) {
    const ToolResult result =
        run_vdbnoise(with(kEvolving, {"--frames", "998-1002x2", "--out", pattern}), in_folder);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }
  ASSERT_EQ(run_vdbnoise(with(kEvolving, {"--frames", "7", "--out", "a.###.vdb"}), in_folder).status, 0);
  EXPECT_EQ(folder.names(),
            (std::set<std::string>{"a.998.vdb", "a.1000.vdb", "a.1002.vdb", "b_998.vdb", "b_1000.vdb",
                                   "b_1002.vdb", "c998.vdb", "c1000.vdb", "c1002.vdb", "a.007.vdb"}));
}

// A frame is the same by itself and in any sequence; its moment is its number over the frame rate.
TEST(Sequence, FrameIsAtItsNumberOverTheRate) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  run_vdbnoise(with(kEvolving, {"--frames", "10-14", "--fps", "8", "--out", "s.##.vdb"}), in_folder);
  run_vdbnoise(with(kEvolving, {"--frames", "12", "--fps", "8", "--out", "one.##.vdb"}), in_folder);
  run_vdbnoise(with(kEvolving, {"--time", "1.5", "--out", "time.vdb"}), in_folder);
  expect_same_grid(folder.file("s.12.vdb"), folder.file("one.12.vdb"));
  const auto metadata = read_vdb_summary(folder.file("s.12.vdb")).metadata;
  EXPECT_EQ(metadata.at("frame"), "12");
  EXPECT_EQ(metadata.at("fps"), "8");
  EXPECT_TRUE(same_values(folder.file("s.12.vdb"), folder.file("time.vdb")));
}

TEST(Sequence, KeepsFramesThatAreWholeAndOfTheSameRecipe) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const auto frames = [&](const char* which, const std::vector<std::string>& more) {
    return run_vdbnoise(with(with(kEvolving, {"--frames", which, "--out", "s.##.vdb"}), more), in_folder);
  };
  ASSERT_EQ(frames("1-2", {}).status, 0);
  const auto before = std::filesystem::last_write_time(folder.file("s.01.vdb"));
  EXPECT_EQ(frames("1-3", {}).status, 1);
  ASSERT_EQ(frames("1-3", {"--skip-existing"}).status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(folder.file("s.01.vdb")), before);
  EXPECT_EQ(folder.names().count("s.03.vdb"), 1u);

  const ToolResult other = frames("1-3", {"--skip-existing", "--seed", "9"});
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("s.01.vdb: exists already, and is damaged or of another recipe"),
            std::string::npos);
  std::filesystem::resize_file(folder.file("s.02.vdb"), 2000);
  const ToolResult cut = frames("1-3", {"--skip-existing"});
  EXPECT_EQ(cut.status, 1);
  EXPECT_NE(cut.err.find("s.02.vdb: exists already, and is damaged"), std::string::npos) << cut.err;
}

// Readable, of this recipe, and yet not what was made.
TEST(Sequence, KeepsNoFrameWhoseVoxelsAreOthers) {
  const TemporaryFolder folder;
  const auto frame = [&](const std::vector<std::string>& more) {
    return run_vdbnoise(with(with(kEvolving, {"--skip-existing", "--frames", "1", "--out", "s.#.vdb"}), more),
                        {.folder = folder.path()});
  };
  for (const bool half : {false, true}) {
    const std::vector<std::string> more =
        half ? std::vector<std::string>{"--half"} : std::vector<std::string>{};
    std::filesystem::remove(folder.file("s.1.vdb"));
    ASSERT_EQ(frame(more).status, 0);
    ASSERT_EQ(frame(more).status, 0) << "it is kept";
    const auto changed = [&](const auto& change) {
      const openvdb::FloatGrid::Ptr grid = read_float_grid(folder.file("s.1.vdb"));
      change(*grid);
      VdbWriteOptions options;
      options.existing = Existing::replace;
      write_vdb(folder.file("s.1.vdb"), {grid}, options);
    };
    changed([](openvdb::FloatGrid& grid) { grid.beginValueOn().setValue(5.0f); });
    EXPECT_EQ(frame(more).status, 1);
    changed([](openvdb::FloatGrid& grid) { grid.clear(); });
    EXPECT_EQ(frame(more).status, 1);
  }
}

TEST(Sequence, LastFramesSuccessorIsTheFirstToTheLastBit) {
  const std::vector<std::vector<std::string>> moving{
      kEvolving, {"--raw", "--dim", "12", "--frequency", "2", "--dims", "4", "--quiet"}};
  for (const auto& arguments : moving) {
    const TemporaryFolder folder;
    // 48 frames; 1001 and 1049 are a loop apart.
    const ToolResult result =
        run_vdbnoise(with(arguments, {"--frames", "1001-1049x24", "--loop", "2", "--out", "s.####.vdb"}),
                     {.folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(same_values(folder.file("s.1001.vdb"), folder.file("s.1049.vdb")));
    EXPECT_FALSE(same_values(folder.file("s.1001.vdb"), folder.file("s.1025.vdb")));
  }
}

// Until a file is there; at most a minute.
void wait_for(const TemporaryFolder& folder, const std::string& name) {
  const auto give_up = std::chrono::steady_clock::now() + 60s;
  while (folder.names().count(name) == 0 && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(1ms);
  }
}

// Once the first frame is there, something takes the place of the last one.
TEST(Sequence, FailedFrameLeavesTheOthers) {
  const TemporaryFolder folder;
  RunningTool tool(
      in_build("tools/vdbnoise"),
      {"--raw", "--dim", "128", "--evolve", "1", "--quiet", "--frames", "1-9", "--out", "s.#.vdb"},
      {.folder = folder.path()});
  wait_for(folder, "s.1.vdb");
  folder.write("s.9.vdb", "precious");
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("vdbnoise: frame 9: s.9.vdb: exists already"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("1 of 9 frames failed"), std::string::npos) << result.err;
  EXPECT_EQ(folder.read("s.9.vdb"), "precious");
  EXPECT_EQ(folder.names().size(), 9u);
}

TEST(Sequence, InterruptionLeavesTheFramesBefore) {
  const TemporaryFolder folder;
  RunningTool tool(
      in_build("tools/vdbnoise"),
      {"--raw", "--dim", "160", "--evolve", "1", "--quiet", "--frames", "1-99", "--out", "s.##.vdb"},
      {.folder = folder.path()});
  wait_for(folder, "s.01.vdb");
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT);
  const std::size_t frames = folder.count();
  EXPECT_GE(frames, 1u);
  EXPECT_LT(frames, 99u);
  const std::string next = "frame " + std::to_string(frames + 1) + "; frames before it are";
  EXPECT_NE(result.err.find(next), std::string::npos) << result.err;
}

TEST(Sequence, WritesTheRecipeOfAllFramesOnce) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const ToolResult result = run_vdbnoise(
      with(kEvolving, {"--frames", "5-6", "--out", "s.#.vdb", "--write-recipe", "s.json"}), in_folder);
  ASSERT_EQ(result.status, 0) << result.err;
  run_vdbnoise({"--recipe", "s.json", "--frames", "6", "--out", "again.#.vdb", "--quiet"}, in_folder);
  expect_same_grid(folder.file("s.6.vdb"), folder.file("again.6.vdb"));
}

const std::vector<std::string> kBoiling{"--preset", "smoke", "--dim", "40", "--evolve", "1", "--quiet"};

std::string density_factor(const std::string& file) {
  return read_vdb_summary(file).grids[0].metadata.at("solidnoise:density_factor");
}

// All frames have the scale of frame 0, whether it is made or not.
TEST(Sequence, HasOneDensityScale) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const auto run = [&](const std::vector<std::string>& more) {
    const ToolResult result = run_vdbnoise(with(kBoiling, more), in_folder);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  run({"--frames", "11-13", "--out", "s.#.vdb"});
  run({"--frames", "12", "--out", "one.#.vdb"});
  run({"--out", "zero.vdb"});
  run({"--time", "0.5", "--out", "own.vdb"});
  expect_same_grid(folder.file("s.12.vdb"), folder.file("one.12.vdb"));
  const std::string factor = density_factor(folder.file("zero.vdb"));
  for (const char* frame : {"s.11.vdb", "s.12.vdb", "s.13.vdb"}) {
    EXPECT_EQ(density_factor(folder.file(frame)), factor);
  }
  // Frame 12 is at time 0.5, where its own scale would be another.
  EXPECT_NE(density_factor(folder.file("own.vdb")), factor);
  EXPECT_FALSE(same_values(folder.file("s.12.vdb"), folder.file("own.vdb")));
  // It is made again from its own recipe.
  EXPECT_EQ(run_vdbnoise({"--recipe", "s.12.vdb", "--out", "again.vdb", "--quiet"}, in_folder).status, 0);
  EXPECT_TRUE(same_values(folder.file("s.12.vdb"), folder.file("again.vdb")));
}

// Machines that share a recipe measure nothing, and the shards of a frame are scaled as the frame is.
TEST(Sequence, SharesItsDensityScaleByTheRecipeAndBetweenShards) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  const auto run = [&](const std::vector<std::string>& arguments) {
    const ToolResult result = run_vdbnoise(arguments, in_folder);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  run(with(kBoiling, {"--frames", "12", "--out", "s.#.vdb"}));
  run(with(kBoiling, {"--frames", "1-48", "--write-recipe", "s.json"}));
  EXPECT_NE(folder.read("s.json").find("\"factor\""), std::string::npos);
  run({"--recipe", "s.json", "--frames", "12", "--out", "again.#.vdb", "--quiet"});
  expect_same_grid(folder.file("s.12.vdb"), folder.file("again.12.vdb"));
  for (const std::string shard : {"1", "2", "3"}) {
    run(with(kBoiling, {"--frames", "12", "--shard", shard + "/3", "--out", "part" + shard + ".#.vdb"}));
  }
  run({"merge", "part1.12.vdb", "part2.12.vdb", "part3.12.vdb", "--out", "merged.vdb", "--quiet"});
  expect_same_grid(folder.file("s.12.vdb"), folder.file("merged.vdb"));
}

TEST(Sequence, ThatBeginsEmptyNeedsADensityFactor) {
  const TemporaryFolder folder;
  folder.write(
      "empty.json",
      R"({"solidnoise": 1, "noise": {"type": "gabor", "evolve": 1}, "shaping": {"type": "remap", "threshold": 50}})");
  const std::vector<std::string> arguments{"--recipe", "empty.json", "--dim", "12",
                                           "--frames", "1",          "--out", "x.#.vdb"};
  const ToolResult refused = run_vdbnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("empty at time 0"), std::string::npos) << refused.err;
  EXPECT_EQ(folder.names(), std::set<std::string>{"empty.json"});
  const ToolResult given =
      run_vdbnoise(with(arguments, {"--density-factor", "2"}), {.folder = folder.path()});
  EXPECT_EQ(given.status, 0) << given.err;
}

// A simulation's frames, each with its own noise; one of them is missing.
TEST(Sequence, ModifiesAFileOfEachFrame) {
  const TemporaryFolder folder;
  const RunOptions in_folder{.folder = folder.path()};
  run_vdbnoise({"--preset", "smoke", "--dim", "24", "--evolve", "1", "--frames", "8-11", "--out",
                "sim.####.vdb", "--quiet"},
               in_folder);
  std::filesystem::remove(folder.path() / "sim.0009.vdb");
  const std::vector<std::string> detail{"--combine", "erode", "--frequency", "3", "--quiet"};
  const ToolResult result = run_vdbnoise(
      with({"--on", "sim.####.vdb", "--frames", "8-11", "--out", "out.%d.vdb"}, detail), in_folder);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("frame 9: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("sim.0009.vdb: cannot be read"), std::string::npos) << result.err;
  for (const std::string frame : {"8", "10", "11"}) {
    const std::string number = std::string(4 - frame.size(), '0') + frame;
    run_vdbnoise(with({"--on", "sim." + number + ".vdb", "--out", "one." + frame + ".vdb"}, detail),
                 in_folder);
    EXPECT_TRUE(same_values(folder.file("out." + frame + ".vdb"), folder.file("one." + frame + ".vdb")));
  }
}

struct Refusal {
  std::vector<std::string> arguments;
  std::string says;
};

TEST(Sequence, RefusesWhatIsNoSequence) {
  const std::vector<std::string> evolving = with(kEvolving, {"--frames", "1-2"});
  const std::vector<Refusal> refusals{
      {with(evolving, {"--out", "s.vdb"}), "--out is s.vdb; of several frames it must have a place"},
      {with(evolving, {"--out", "s.#.x.vdb"}), "--out is s.#.x.vdb; it must have a place"},
      {with(evolving, {"--out", "s.##########.vdb"}), "at most 9 digits"},
      {with(evolving, {"--out", "s.#.vdb", "--preview", "s.png"}), "--preview is s.png; of several frames"},
      {with(evolving, {"--out", "-"}), "--out is -"},
      {with(evolving, {"--out", "s.#.vdb", "--fps", "0"}), "--fps is 0; it must be between"},
      {with(evolving, {"--out", "s.#.vdb", "--loop", "0.3"}),
       "--loop is 0.3, which at 24 frames per unit of time is 7.2"},
      {with(kEvolving, {"--out", "s.#.vdb"}),
       "--out is s.#.vdb, which has a place for the number of a frame; give --frames"},
      {with(kEvolving, {"--out", "s.vdb", "--fps", "25"}), "--fps has no effect without --frames"},
      {{"--on", "s.#.vdb", "--out", "x.vdb"},
       "s.#.vdb, which has a place for the number of a frame; give --frames"},
      {{"--on", "s.#.vdb", "--out", "x.#.vdb", "--frames", "1", "--write-recipe", "x.json"},
       "--write-recipe"},
      {{"--on", "s.vdb", "--out", "x.vdb", "--shard", "1/2"}, "--shard and --region"},
      {{"--raw", "--frames", "1-2", "--out", "s.#.vdb"},
       "--frames has no effect on a noise that does not change"},
  };
  for (const Refusal& refusal : refusals) {
    const TemporaryFolder folder;
    const ToolResult result = run_vdbnoise(refusal.arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find(refusal.says), std::string::npos) << result.err;
    EXPECT_TRUE(folder.names().empty());
  }
  for (const char* frames : {"-3-4", "4-3", "a", "1-2x0", "1-5x", "1..4", "1-", "0-99999999"}) {
    const ToolResult result = run_vdbnoise(with(kEvolving, {"--frames", frames, "--out", "s.#.vdb"}));
    EXPECT_EQ(result.status, 2) << frames;
    EXPECT_NE(result.err.find(std::string("--frames is ") + frames), std::string::npos) << result.err;
  }
}

TEST(Sequence, AFrameThatExistsIsRefusedBeforeAnyIsMade) {
  const TemporaryFolder folder;
  folder.write("s.2.vdb", "precious");
  const ToolResult result =
      run_vdbnoise(with(kEvolving, {"--frames", "1-3", "--out", "s.#.vdb"}), {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("s.2.vdb exists; --force replaces it"), std::string::npos) << result.err;
  EXPECT_EQ(folder.names(), std::set<std::string>{"s.2.vdb"});
}

// Only what is right before the extension is the number of a frame.
TEST(Sequence, LetsNamesHaveSignsOfNumbersElsewhere) {
  const TemporaryFolder folder;
  const std::vector<std::string> small{"--raw", "--dim", "8", "--quiet"};
  ASSERT_EQ(run_vdbnoise(with(small, {"--out", "take#2 50%done.vdb"}), {.folder = folder.path()}).status, 0);
  ASSERT_EQ(run_vdbnoise(with(small, {"--evolve", "1", "--frames", "8-9", "--out", "take#2.##.vdb"}),
                         {.folder = folder.path()})
                .status,
            0);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"take#2 50%done.vdb", "take#2.08.vdb", "take#2.09.vdb"}));
}

}  // namespace
}  // namespace solidnoise::sequence_test
