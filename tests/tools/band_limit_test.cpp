#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::band_limit_test {
namespace {

// Noise of two octaves, of which voxels of 0.1 hold the first, in a box of a thousand features.
const std::vector<std::string> kNoise{"--raw", "--frequency", "2.5",     "--octaves", "2", "--error",
                                      "0.01",  "--quiet",     "--force", "--box",     "0", "0",
                                      "0",     "4",           "4",       "4"};

openvdb::FloatGrid::Ptr make(const TemporaryFolder& folder, const std::string& name,
                             const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kNoise;
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {"--out", folder.file(name)});
  const ToolResult result = run_vdbnoise(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return read_float_grid(folder.file(name));
}

// Root mean square of the differences between voxels at the same places, of half the size in `fine`.
double rms_difference(const openvdb::FloatGrid& coarse, const openvdb::FloatGrid& fine) {
  double squares = 0.0;
  for (auto value = coarse.cbeginValueOn(); value; ++value) {
    const openvdb::Coord half = value.getCoord();
    const openvdb::Coord twice(2 * half.x(), 2 * half.y(), 2 * half.z());
    EXPECT_TRUE(fine.tree().isValueOn(twice)) << twice;
    squares += std::pow(*value - fine.tree().getValue(twice), 2);
  }
  return std::sqrt(squares / static_cast<double>(coarse.activeVoxelCount()));
}

// What a filter of half a voxel lets pass of a wave's amplitude.
double response(double voxel, double f) {
  return std::exp(-2.0 * std::pow(std::numbers::pi * 0.5 * voxel * f, 2));
}

// Variance of kNoise after a filter of some response.
template <typename Response>
double filtered_variance(const Response& response) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 2.5, .error = 0.01};
  recipe.fractal.octaves = 2;
  const auto noise = make_noise<3>(recipe);
  const auto shell = [&](double f) {
    return 4.0 * std::numbers::pi * f * f * noise->power_spectrum({f, 0.0, 0.0}) * std::pow(response(f), 2);
  };
  return integrate(shell, 0.0, 20.0, 64);
}

TEST(VdbnoiseBandLimit, HalvingTheVoxelChangesValuesByWhatTheFilterPasses) {
  const TemporaryFolder folder;
  for (const std::string type : {"gabor", "gabor-oriented"}) {
    SCOPED_TRACE(type);
    const auto coarse = make(folder, "coarse.vdb", {"--noise", type, "--voxel", "0.1", "--band-limit"});
    const auto fine = make(folder, "fine.vdb", {"--noise", type, "--voxel", "0.05", "--band-limit"});
    // What one resolution's filter lets pass and the other's does not.
    const double expected =
        std::sqrt(filtered_variance([](double f) { return response(0.05, f) - response(0.1, f); }));
    ASSERT_GT(expected, 0.1);
    // The box has some 1000 independent values, so that a mean square is known to 5 %; 4 sigma of a root mean
    // square are 10 %. Each grid is off by the error, 1 %.
    EXPECT_NEAR(rms_difference(*coarse, *fine), expected, 0.1 * expected + 0.02);
  }
}

TEST(VdbnoiseBandLimit, WithoutItTheSamePlaceHasTheSameValueAndTheToolWarns) {
  const TemporaryFolder folder;
  EXPECT_EQ(rms_difference(*make(folder, "coarse.vdb", {"--voxel", "0.2"}),
                           *make(folder, "fine.vdb", {"--voxel", "0.1"})),
            0.0);
  const std::vector<std::string> coarse{"--raw", "--frequency", "5",     "--voxel",
                                        "0.2",   "--force",     "--out", folder.file("a.vdb")};
  EXPECT_NE(run_vdbnoise(coarse).err.find("will alias; give --band-limit"), std::string::npos);
  std::vector<std::string> limited = coarse;
  limited.emplace_back("--band-limit");
  EXPECT_EQ(run_vdbnoise(limited).err.find("alias"), std::string::npos);
  std::vector<std::string> kensler = coarse;
  kensler.insert(kensler.end(), {"--noise", "kensler"});
  EXPECT_NE(run_vdbnoise(kensler).err.find("will alias; make --voxel"), std::string::npos);
}

TEST(VdbnoiseBandLimit, SaysWhereNothingIsLeft) {
  const TemporaryFolder folder;
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"--raw", "--dim", "16", "--out", folder.file("z.vdb")},
        {"slice", "--dims", "2", "--width", "4", "--resolution", "64", "--out", folder.file("z.png")}}) {
    arguments.insert(arguments.end(), {"--frequency", "300", "--band-limit"});
    const ToolResult result = run_vdbnoise(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("--band-limit leaves nothing"), std::string::npos) << result.err;
  }
}

TEST(VdbnoiseBandLimit, TheRecipeIsKeptAndTheVarianceDescribed) {
  const TemporaryFolder folder;
  const auto made = make(folder, "a.vdb", {"--voxel", "0.2", "--band-limit"});
  const ToolResult again =
      run_vdbnoise({"--recipe", folder.file("a.vdb"), "--quiet", "--out", folder.file("b.vdb")});
  ASSERT_EQ(again.status, 0) << again.err;
  const auto copy = read_float_grid(folder.file("b.vdb"));
  for (auto value = made->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(*value, copy->tree().getValue(value.getCoord()));
  }
  const ToolResult described = run_vdbnoise({"--recipe", folder.file("a.vdb"), "--describe"});
  ASSERT_EQ(described.status, 0) << described.err;
  const auto json = nlohmann::json::parse(described.out);
  EXPECT_EQ(json.at("noise").at("filter"), 0.1);
  // Standard deviations, each off by the error.
  const double variance = filtered_variance([](double f) { return response(0.2, f); });
  EXPECT_NEAR(std::sqrt(json.at("noise").at("variance").get<double>()), std::sqrt(variance), 0.02);
  EXPECT_EQ(json.at("recipe").at("band_limit"), true);
}

// A fold that folds nothing makes no layer, which band limits do not go with.
TEST(VdbnoiseBandLimit, GoesWithAFoldThatFoldsNothing) {
  const TemporaryFolder folder;
  const ToolResult result =
      run_vdbnoise({"--raw", "--dim", "12", "--fold", "none", "--band-limit", "--quiet", "--out", "x.vdb"},
                   {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(run_vdbnoise({"--preset", "cumulus", "--fold", "none", "--describe"}).status, 2);  // on a cloud
}

TEST(VdbnoiseValues, ThatAreAllTheSameAreWarnedOf) {
  const TemporaryFolder folder;
  const auto warns = [&](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"--raw", "--dim", "12", "--force", "--out", "x.vdb"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err.find("warning: all voxels have the same value") != std::string::npos;
  };
  EXPECT_TRUE(warns({"--impulses", "0.001"}));
  EXPECT_TRUE(warns({"--frequency", "1e-12"}));
  EXPECT_FALSE(warns({}));
  EXPECT_FALSE(warns({"--frequency", "1e-12", "--quiet"}));
}

}  // namespace
}  // namespace solidnoise::band_limit_test
