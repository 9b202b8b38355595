#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::time_test {
namespace {

// Noise that changes, the ways in which it may: all with a loop of 2.
const std::vector<std::vector<std::string>> kMoving{
    {"--evolve", "0.4"},
    {"--noise", "gabor-oriented", "--anisotropy", "0.5", "--evolve", "0.4"},
    {"--evolve", "2", "--octaves", "3", "--lacunarity", "1.7"},
    {"--dims", "4", "--octaves", "2"},
    {"--dims", "4", "--noise", "gabor-oriented"},
    {"--dims", "4", "--noise", "kensler"},
};

openvdb::FloatGrid::Ptr frame(const TemporaryFolder& folder, std::vector<std::string> arguments,
                              const std::string& time) {
  const std::string file = folder.file("frame.vdb");
  for (const char* argument : {"--raw", "--dim", "12", "--frequency", "2", "--quiet", "--force", "--loop",
                               "2", "--time", time.c_str(), "--out", file.c_str()}) {
    arguments.emplace_back(argument);
  }
  const ToolResult result = run_vdbnoise(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return read_float_grid(file);
}

TEST(VdbnoiseTime, LastFramesSuccessorIsTheFirstToTheLastBit) {
  for (const auto& arguments : kMoving) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const TemporaryFolder folder;
    const auto first = frame(folder, arguments, "0");
    EXPECT_TRUE(same_values(*first, *frame(folder, arguments, "2")));
    EXPECT_FALSE(same_values(*first, *frame(folder, arguments, "1")));
    // 7 / 24, and 7 / 24 + 2, as decimals.
    const auto other = frame(folder, arguments, "0.29166666666666669");
    EXPECT_TRUE(same_values(*other, *frame(folder, arguments, "2.2916666666666665")));
    EXPECT_FALSE(same_values(*first, *other));
  }
}

TEST(VdbnoiseTime, DescriptionTellsHowFastOctavesTurn) {
  const ToolResult result = run_vdbnoise(
      {"--raw", "--evolve", "0.5", "--octaves", "3", "--lacunarity", "8", "--describe", "--dim", "8"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto evolution = nlohmann::json::parse(result.out).at("noise").at("evolution");
  for (int k = 0; k < 3; ++k) {
    const double rate = 0.5 * std::pow(4.0, k);
    EXPECT_NEAR(evolution.at("octave_rates").at(k).get<double>(), rate, 1e-12 * rate);
    EXPECT_NEAR(evolution.at("octave_half_lives").at(k).get<double>(), 0.18739 / rate, 1e-5 / rate);
  }
}

TEST(VdbnoiseTime, WarnsOfLoopsThatAreTooShortForTheRate) {
  const auto says = [](const char* rate, const char* loop) {
    const TemporaryFolder folder;
    return run_vdbnoise({"--raw", "--dim", "8", "--frequency", "2", "--evolve", rate, "--loop", loop, "--out",
                         folder.file("x.vdb")})
        .err;
  };
  const std::string warning = says("0.4", "2");
  EXPECT_NE(warning.find("correlation -0.60"), std::string::npos) << warning;
  EXPECT_NE(warning.find("--evolve 1 or --loop 5"), std::string::npos) << warning;
  EXPECT_EQ(says("1", "2").find("correlation"), std::string::npos);
  EXPECT_EQ(says("0.4", "5").find("correlation"), std::string::npos);
}

TEST(VdbnoiseTime, ARecipeKeepsRateLoopAndTime) {
  const TemporaryFolder folder;
  const auto made = frame(folder, kMoving[0], "0.7");
  const ToolResult result =
      run_vdbnoise({"--recipe", folder.file("frame.vdb"), "--quiet", "--out", folder.file("again.vdb")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(same_values(*made, *read_float_grid(folder.file("again.vdb"))));
}

}  // namespace
}  // namespace solidnoise::time_test
