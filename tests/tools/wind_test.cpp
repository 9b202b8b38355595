#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::wind_test {
namespace {

void run_well(const TemporaryFolder& folder, std::vector<std::string> arguments,
              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
}

// 12 frames at 24 a second, 0.5 units of wind a second: half a second of it is a quarter of a unit.
TEST(Wind, MovesNoiseThatStandsStill) {
  const TemporaryFolder folder;
  const std::vector<std::string> raw{"--raw", "--dim", "12", "--frequency", "2", "--quiet"};
  run_well(folder, raw, {"--wind", "0.5", "0", "-1", "--frames", "12", "--fps", "24", "--out", "w.##.vdb"});
  run_well(folder, raw, {"--offset", "0.25", "0", "-0.5", "--out", "moved.vdb"});
  EXPECT_TRUE(same_values(folder.file("w.12.vdb"), folder.file("moved.vdb")));
}

TEST(Wind, GoesRoundALoopInWholePeriodsOnly) {
  const TemporaryFolder folder;
  const std::vector<std::string> raw{"--raw", "--dim",    "12",      "--frequency", "2",     "--period",
                                     "4",     "4",        "4",       "--evolve",    "1",     "--loop",
                                     "2",     "--frames", "0-48x48", "--quiet",     "--out", "l.##.vdb"};
  run_well(folder, raw, {"--wind", "2", "0", "0"});
  EXPECT_TRUE(same_values(folder.file("l.00.vdb"), folder.file("l.48.vdb")));
  // 0.1 * 3 is not 0.3 in binary numbers.
  run_well(
      folder, {"--raw", "--dim", "12", "--quiet", "--evolve", "0.5", "--loop", "3"},
      {"--period", "0.3", "0.3", "0.3", "--frequency", "12", "--wind", "0.1", "0", "0", "--out", "r.vdb"});
  std::vector<std::string> odd = raw;
  odd.insert(odd.end(), {"--wind", "1", "0", "0"});
  expect_refusal(run_vdbnoise(odd), {"", 2, {}, {"--wind is 1 along x", "whole number"}}, "vdbnoise");
}

// A frame is what the number at its place of the curve makes, whether it is made alone or with others.
TEST(Curves, AreLinearBetweenTheirKeysAndHeldOutside) {
  const TemporaryFolder folder;
  const std::vector<std::string> raw{"--raw", "--dim", "12", "--quiet", "--frequency", "10:2,20:4"};
  run_well(folder, raw, {"--frames", "5-25x5", "--out", "c.##.vdb"});
  run_well(folder, raw, {"--frames", "15", "--out", "one.##.vdb"});
  expect_same_grid(folder.file("c.15.vdb"), folder.file("one.15.vdb"));
  for (const auto& [frame, frequency] : {std::pair("05", "2"), {"10", "2"}, {"15", "3"}, {"25", "4"}}) {
    const std::string still = std::string("still") + frame + ".vdb";
    run_well(folder, {"--raw", "--dim", "12", "--quiet"}, {"--frequency", frequency, "--out", still});
    EXPECT_TRUE(same_values(folder.file("c." + std::string(frame) + ".vdb"), folder.file(still))) << frame;
  }
}

// The factor of a sequence is measured once, at frame 0; twice the density is twice the values, exactly.
TEST(Curves, OfDensityScaleOneFactor) {
  const TemporaryFolder folder;
  run_well(folder, {"--preset", "smoke", "--dim", "16", "--quiet"},
           {"--density", "0:1,8:4", "--frames", "0-8x8", "--out", "d.#.vdb"});
  const auto first = read_float_grid(folder.file("d.0.vdb"));
  const auto last = read_float_grid(folder.file("d.8.vdb"));
  ASSERT_GT(first->activeVoxelCount(), 0U);
  for (auto value = first->cbeginValueOn(); value; ++value) {
    // Single precision rounds each of them once.
    EXPECT_NEAR(last->tree().getValue(value.getCoord()), 4.0 * *value, 1e-6 * *value);
  }
}

TEST(SliceOfVectors, ShowsColoursOrAComponent) {
  const TemporaryFolder folder;
  run_well(folder, {"--output", "curl", "--dim", "12", "--quiet"}, {"--out", "v.vdb"});
  const std::vector<std::string> slice{"slice", "v.vdb", "--resolution", "8"};
  run_well(folder, slice, {"--out", "all.png", "--quiet"});
  run_well(folder, slice, {"--out", "y.csv", "--component", "y", "--quiet"});
  run_well(folder, slice, {"--out", "length.png", "--component", "length", "--ramp", "viridis", "--quiet"});
  EXPECT_EQ(std::ranges::count(folder.read("y.csv"), '\n'), 9);
  std::vector<std::string> ramp = slice;
  ramp.insert(ramp.end(), {"--out", "no.png", "--ramp", "viridis"});
  expect_refusal(run_vdbnoise(ramp, {.folder = folder.path()}), {"", 2, {}, {"--ramp", "--component"}},
                 "vdbnoise slice");
}

}  // namespace
}  // namespace solidnoise::wind_test
