#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::analyze_test {
namespace {

Json analyze(const std::vector<std::string>& recipe_flags) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"--quiet", "--out", folder.file("x.vdb")};
  arguments.insert(arguments.end(), recipe_flags.begin(), recipe_flags.end());
  const ToolResult made = run_vdbnoise(arguments);
  EXPECT_EQ(made.status, 0) << made.err;
  const ToolResult result = run_vdbnoise({"analyze", folder.file("x.vdb")});
  EXPECT_EQ(result.status, 0) << result.err;
  return parse_json(result.out);
}

// The seeds are fixed. The closed form would be refused falsely for one seed in 10000.
TEST(Analyze, FindsTheClosedFormOfTheStoredRecipeInTheGrid) {
  const std::vector<std::vector<std::string>> noises{
      {"--noise", "gabor", "--octaves", "2"},
      {"--noise", "gabor-oriented", "--anisotropy", "0.8", "--direction", "0", "1", "1"},
      {"--noise", "kensler"},
      {"--dims", "4", "--time", "0.4"},
  };
  for (std::vector<std::string> flags : noises) {
    flags.insert(flags.end(), {"--raw", "--frequency", "5", "--dim", "48", "--seed", "11"});
    const Json json = analyze(flags);
    ASSERT_TRUE(json["spectrum"].is_object()) << flags[1];
    EXPECT_EQ(json["moments"]["voxels"], 48 * 48 * 48);
    EXPECT_NEAR(json["expected"]["variance"].get<double>(), 1.0, 1e-6) << flags[1];
    EXPECT_GE(json["spectrum"]["degrees_of_freedom"], 2) << flags[1];
    EXPECT_GT(json["spectrum"]["significance"].get<double>(), 1e-4) << flags[1];
  }
}

TEST(Analyze, ExpectsNothingOfShapedValues) {
  const TemporaryFolder folder;
  const std::vector<std::string> grid{"--raw", "--dim", "80", "--quiet", "--seed", "11"};
  std::vector<std::string> arguments = grid;
  arguments.insert(arguments.end(), {"--frequency", "5", "--range", "unit", "--out", folder.file("a.vdb")});
  ASSERT_EQ(run_vdbnoise(arguments).status, 0);
  const ToolResult result = run_vdbnoise({"analyze", folder.file("a.vdb")});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = parse_json(result.out);
  EXPECT_TRUE(json["expected"].is_null()) << "values in another range have no closed form";
  EXPECT_NEAR(json["moments"]["mean"].get<double>(), 0.5, 0.05);
  EXPECT_FALSE(json["spectrum"].contains("chi_square"));
}

TEST(Analyze, ExpectsNothingOfWhatIsMadeOfTheNoise) {
  EXPECT_TRUE(analyze({"--raw", "--output", "phase", "--noise", "gabor-oriented", "--dim", "24"})["expected"]
                  .is_null());
  EXPECT_TRUE(analyze({"--raw", "--output", "value,gradient", "--dim", "24"})["expected"].is_object());
  const TemporaryFolder folder;
  ASSERT_EQ(run_vdbnoise({"--raw", "--dim", "24", "--quiet", "--out", folder.file("a.vdb")}).status, 0);
  EXPECT_TRUE(
      analyze({"--on", folder.file("a.vdb"), "--combine", "add", "--amount", "3", "--raw"})["expected"]
          .is_null());
}

// A comparison with waves far shorter than a voxel, or longer than the block, would take as long as the
// frequency that a file has likes.
TEST(Analyze, ComparesWhatTheVoxelsCanShow) {
  for (const char* frequency : {"1e-6", "1e5"}) {
    const Json json = analyze({"--raw", "--frequency", frequency, "--dim", "16"});
    EXPECT_FALSE(json["spectrum"].is_object() && json["spectrum"].contains("chi_square")) << frequency;
    EXPECT_TRUE(json["expected"].is_object()) << frequency;
  }
}

TEST(Analyze, CountsEveryVoxelInTheHistogram) {
  const Json json = analyze({"--raw", "--frequency", "5", "--dim", "48"});
  double counted = 0.0;
  double gaussian = 0.0;
  for (const Json& count : json["histogram"]["counts"]) counted += count.get<double>();
  for (const Json& count : json["histogram"]["gaussian_counts"]) gaussian += count.get<double>();
  EXPECT_NEAR(counted, 48.0 * 48.0 * 48.0, 48.0);  // values beyond 5 sigmas are in no bin
  EXPECT_NEAR(gaussian, 48.0 * 48.0 * 48.0, 1.0);  // 6e-7 of a Gaussian lies beyond
  EXPECT_LT(json["histogram"]["largest_difference_of_distributions"].get<double>(), 0.1);
}

TEST(Analyze, PlotsNoiseAndKernel) {
  const TemporaryFolder folder;
  for (const std::string noise : {"gabor", "gabor-oriented", "kensler"}) {
    ASSERT_EQ(run_vdbnoise({"--raw", "--noise", noise, "--frequency", "4", "--dim", "32", "--quiet",
                            "--force", "--out", folder.file("x.vdb")})
                  .status,
              0);
    const ToolResult result =
        run_vdbnoise({"analyze", folder.file("x.vdb"), "--plot", folder.file(noise + ".png")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(folder.read(noise + ".png").substr(1, 3), "PNG");
  }
  const std::string before = folder.read("kensler.png");
  EXPECT_EQ(run_vdbnoise({"analyze", folder.file("x.vdb"), "--plot", folder.file("kensler.png")}).status, 1);
  EXPECT_EQ(folder.read("kensler.png"), before) << "replaced without --force";
  EXPECT_EQ(run_vdbnoise({"analyze", folder.file("x.vdb"), "--plot", folder.file("x.gif")}).status, 2);
}

TEST(Analyze, MeasuresTheMomentsOfACloud) {
  const Json json = analyze({"--dim", "32", "--octaves", "2"});
  EXPECT_GT(json["moments"]["voxels"].get<int>(), 1000);
  EXPECT_GE(json["moments"]["min"].get<double>(), 0.0);
  EXPECT_TRUE(json["expected"].is_null());
}

TEST(Analyze, RefusesValuesThatAreNotFinite) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create();
  grid->setName("density");
  grid->tree().setValue({1, 2, 3}, 1.0f);
  grid->tree().setValue({4, 5, 6}, HUGE_VALF);
  grid->tree().setValue({40, 5, 6}, std::nanf(""));
  openvdb::io::File(folder.file("inf.vdb")).write(openvdb::GridCPtrVec{grid});
  const ToolResult result = run_vdbnoise({"analyze", folder.file("inf.vdb")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "vdbnoise: " + folder.file("inf.vdb") +
                ": grid 'density' has 2 values that are not finite, the first at voxel (4, 5, 6)\n");
}

}  // namespace
}  // namespace solidnoise::analyze_test
