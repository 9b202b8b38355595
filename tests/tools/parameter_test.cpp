// Parameters from grids, through the real program.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/volume/vdb/grid_values.h"
#include "support/parameter_grids.h"
#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::parameter_test {
namespace {

using Arguments = std::vector<std::string>;
using openvdb::FloatGrid;

class Parameters : public testing::Test {
 protected:
  Parameters() { write_painted_grids(folder_.file("painted.vdb")); }

  ToolResult run(const Arguments& arguments) const {
    return run_vdbnoise(arguments, {.folder = folder_.path()});
  }

  // What it says.
  std::string make(const std::string& out, Arguments arguments, const Arguments& more = {}) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"--out", out});
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  }

  TemporaryFolder folder_;
};

const Arguments kAllGrids{"--frequency-grid",
                          "painted.vdb:ramp",
                          "--bandwidth-grid",
                          "painted.vdb:narrow",
                          "--direction-grid",
                          "painted.vdb:turn",
                          "--magnitude-grid",
                          "painted.vdb:paint",
                          "--magnitude-map",
                          "0",
                          "1",
                          "0.5",
                          "2",
                          "--raw"};

// What is folded is the noise whose kernels vary, and the magnitude multiplies what layers make.
TEST_F(Parameters, VaryInLayersToo) {
  const auto values_of = [&](const Arguments& grids, const Arguments& more) {
    Arguments arguments = grids;
    arguments.insert(arguments.end(), {"--raw", "--dim", "24", "--quiet", "--force"});
    make("x.vdb", arguments, more);
    std::vector<double> values;
    const FloatGrid::Ptr grid = read_float_grid(folder_.file("x.vdb"));
    for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) values.push_back(*voxel);
    return values;
  };
  const Arguments kernels{"--frequency-grid", "painted.vdb:ramp", "--bandwidth-grid", "painted.vdb:narrow"};
  Arguments all = kernels;
  all.insert(all.end(), {"--magnitude-grid", "painted.vdb:paint"});
  const std::vector<double> plain = values_of(kernels, {});
  const std::vector<double> folded = values_of(kernels, {"--fold", "billow"});
  const std::vector<double> magnified = values_of(all, {});
  const std::vector<double> both = values_of(all, {"--fold", "billow"});
  ASSERT_EQ(plain.size(), 24u * 24u * 24u);
  const double mean = std::sqrt(2.0 / std::numbers::pi);
  const double deviation = std::sqrt(1.0 - 2.0 / std::numbers::pi);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(folded[i], (std::abs(plain[i]) - mean) / deviation, 1e-5) << i;
    EXPECT_NEAR(both[i] * plain[i], folded[i] * magnified[i], 1e-5) << i;
  }
}

TEST_F(Parameters, ShardsMergeToTheWholeToTheLastBit) {
  Arguments cloud{"--frequency-grid", "painted.vdb:ramp", "--dim", "40", "--quiet"};
  Arguments noise = kAllGrids;
  noise.insert(noise.end(), {"--dim", "40", "--octaves", "2", "--dims", "4", "--time", "0.3", "--quiet"});
  for (const Arguments& arguments : {cloud, noise}) {
    make("whole.vdb", arguments, {"--force", "--threads", "1"});
    for (const char* shard : {"1", "2", "3"}) {
      make(std::string("part") + shard + ".vdb", arguments,
           {"--shard", std::string(shard) + "/3", "--force"});
    }
    EXPECT_EQ(run({"merge", "part2.vdb", "part1.vdb", "part3.vdb", "--out", "merged.vdb", "--force"}).status,
              0);
    expect_same_grid(folder_.file("merged.vdb"), folder_.file("whole.vdb"));
    EXPECT_GT(read_float_grid(folder_.file("whole.vdb"))->activeVoxelCount(), 1000u);
  }
}

// The recipe in the file, with the digests of the grids' files.
TEST_F(Parameters, AreMadeAgainFromTheRecipeAndNoOtherGrids) {
  Arguments noise = kAllGrids;
  noise.insert(noise.end(), {"--dim", "24", "--write-recipe", "recipe.json", "--quiet"});
  make("a.vdb", noise);
  make("b.vdb", {"--recipe", "a.vdb", "--quiet"});
  make("c.vdb", {"--recipe", "recipe.json", "--quiet"});
  expect_same_grid(folder_.file("a.vdb"), folder_.file("b.vdb"));
  expect_same_grid(folder_.file("a.vdb"), folder_.file("c.vdb"));
  const ToolResult info = run({"info", "a.vdb"});
  EXPECT_NE(info.out.find("frequency_grid"), std::string::npos) << info.out;

  write_vdb(folder_.file("painted.vdb"),
            {grid_of<FloatGrid>("ramp", 0.25, cube_of(-6, 6), [](double, double, double) { return 1.0f; })},
            {.existing = Existing::replace});
  const ToolResult other = run({"--recipe", "a.vdb", "--out", "d.vdb"});
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("painted.vdb: is not the file that the recipe was made with"), std::string::npos)
      << other.err;
}

// The default preset and all others of one grid and one noise take a frequency from a grid that is there
// everywhere.
TEST_F(Parameters, GoWithEveryPreset) {
  for (const char* preset : {"cumulus", "smoke", "raw"}) {
    SCOPED_TRACE(preset);
    const std::string grid = folder_.file("everywhere.vdb");
    write_vdb(grid,
              {grid_of<FloatGrid>("f", 0.5, cube_of(-5, 5),
                                  [](double x, double, double) { return static_cast<float>(3.0 + x); })},
              {.existing = Existing::replace});
    make("x.vdb", {"--preset", preset, "--frequency-grid", "everywhere.vdb", "--dim", "32", "--force"});
    make("y.vdb", {"--preset", preset, "--dim", "32", "--force"});
    EXPECT_FALSE(same_values(folder_.file("x.vdb"), folder_.file("y.vdb")));
  }
}

// 2 pi 4 cycles on one side and 2 on the other: the noise is as strong on both, and as fine as it should be.
// Mean squares of the noise and of its difference along y: of some 500 independent places each, for which 4
// sigma are 4 sqrt(2.5 / 500) = 0.28.
TEST_F(Parameters, FrequencyFollowsTheGridAndVarianceStays) {
  const std::string file = folder_.file("steps.vdb");
  write_vdb(file,
            {grid_of<FloatGrid>("f", 0.5, cube_of(-9, 9),
                                [](double x, double, double) { return x < 0.0 ? 4.0f : 2.0f; })},
            {});
  make("x.vdb", {"--raw", "--frequency-grid", "steps.vdb", "--box", "-4", "-2", "-2", "4", "2", "2",
                 "--voxel", "0.04", "--quiet"});
  const auto grid = read_float_grid(folder_.file("x.vdb"));
  const auto accessor = grid->getConstAccessor();
  struct Sums {
    double count = 0.0;
    double square = 0.0;
    double slope = 0.0;  // square of the derivative
  };
  std::array<Sums, 2> sides;
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const openvdb::Coord voxel = value.getCoord();
    const double x = grid->indexToWorld(voxel).x();
    const openvdb::Coord next = voxel.offsetBy(0, 1, 0);
    if (std::abs(x) < 0.6 || !accessor.isValueOn(next)) continue;
    Sums& side = sides[x < 0.0 ? 0 : 1];
    side.count += 1.0;
    side.square += *value * *value;
    side.slope += std::pow((accessor.getValue(next) - *value) / 0.04, 2);
  }
  for (const Sums& side : sides) EXPECT_NEAR(side.square / side.count, 1.0, 0.28);
  const double ratio = sides[0].slope / sides[0].count / (sides[1].slope / sides[1].count);
  EXPECT_NEAR(ratio, 4.0, 1.2);  // squares of the frequencies
}

TEST_F(Parameters, DisplaceAndCombineGridsThatExist) {
  const auto surface = openvdb::tools::createLevelSetSphere<FloatGrid>(0.6f, openvdb::Vec3f(0), 0.05f);
  surface->setName("surface");
  write_vdb(folder_.file("surface.vdb"), {surface}, {});
  make("rock.vdb", {"--on", "surface.vdb", "--displace", "0.03", "--frequency-grid", "painted.vdb:ramp"});
  make("flat.vdb", {"--on", "surface.vdb", "--displace", "0.03", "--frequency", "4"});
  EXPECT_FALSE(same_values(folder_.file("rock.vdb"), folder_.file("flat.vdb")));

  // A magnitude that is 0 leaves the grid as it is.
  const std::string still = folder_.file("still.vdb");
  write_vdb(still,
            {grid_of<FloatGrid>("m", 0.25, cube_of(-6, 6), [](double, double, double) { return 0.0f; })}, {});
  make("fog.vdb", {"--raw", "--range", "unit", "--dim", "24"});
  make("same.vdb", {"--on", "fog.vdb", "--combine", "add", "--magnitude-grid", "still.vdb"});
  EXPECT_TRUE(same_values(folder_.file("fog.vdb"), folder_.file("same.vdb")));
}

TEST_F(Parameters, AreDescribed) {
  const ToolResult result = run({"--describe", "--raw", "--frequency-grid", "painted.vdb:ramp",
                                 "--magnitude-grid", "painted.vdb:paint", "--dim", "32"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json["noise"]["from_grids"]["frequency"][0].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(json["noise"]["from_grids"]["frequency"][1].get<double>(), 6.0, 1e-6);
  EXPECT_EQ(json["noise"]["variance"].get<double>(), 1.0);
  const double upper = json["noise"]["band_cycles_per_unit"][1].get<double>();
  EXPECT_GT(upper, 6.0);
  EXPECT_LT(upper, 18.0);
  EXPECT_EQ(json["recipe"]["frequency_grid"]["grid"], "ramp");
}

// One process for a sequence of grids, as simulations leave them.
TEST_F(Parameters, MayHaveAFileForEachFrame) {
  for (const int frame : {1, 2}) {
    write_vdb(folder_.file("f." + std::to_string(frame) + ".vdb"),
              {grid_of<FloatGrid>("f", 0.5, cube_of(-4, 4),
                                  [=](double, double, double) { return 1.0f + static_cast<float>(frame); })},
              {});
  }
  make("x.#.vdb", {"--raw", "--frequency-grid", "f.#.vdb", "--frames", "1-2", "--dim", "16", "--quiet"});
  EXPECT_FALSE(same_values(folder_.file("x.1.vdb"), folder_.file("x.2.vdb")));
}

void write_bad_grids(const TemporaryFolder& folder) {
  const auto constant = [](float value) { return [=](double, double, double) { return value; }; };
  const auto hole = grid_of<FloatGrid>("hole", 0.25, cube_of(-6, 6), constant(2.0f));
  hole->tree().setValue(openvdb::Coord(1, 2, 3), -4.0f);
  hole->tree().setValue(openvdb::Coord(2, 0, 0), 0.0f);
  const auto nan = grid_of<FloatGrid>("nan", 0.25, cube_of(-6, 6), constant(2.0f));
  nan->tree().setValue(openvdb::Coord(-3, 0, 1), std::numeric_limits<float>::quiet_NaN());
  const auto half = grid_of<FloatGrid>("half", 0.25, {{0, -6, -6}, {6, 6, 6}}, constant(2.0f));
  const auto far = grid_of<FloatGrid>("far", 0.25, cube_of(30, 40), constant(2.0f));
  const auto wide = grid_of<FloatGrid>("wide", 0.25, cube_of(-6, 6), constant(5.0f));
  const auto empty = FloatGrid::create();
  empty->setName("empty");
  const auto mask = openvdb::BoolGrid::create();
  mask->setName("mask");
  write_vdb(folder.file("bad.vdb"), {hole, nan, half, far, wide, empty, mask}, {});
  write_painted_grids(folder.file("painted.vdb"));
}

class BadParameters : public testing::TestWithParam<Refusal> {};

TEST_P(BadParameters, AreRefusedInOneLineAndNothingIsWritten) {
  const Refusal& refusal = GetParam();
  const TemporaryFolder folder;
  write_bad_grids(folder);
  const auto write_recipe = [&](const std::string& name, const std::string& layer) {
    folder.write(
        name, R"({"solidnoise": 2, "noise": {"type": "gabor"}, "grids": [{"name": "density", "layers": [)" +
                  layer + R"(], "shaping": {"type": "raw"}}]})");
  };
  write_recipe("other_layers.json", R"({"noise": {"type": "kensler"}})");
  write_recipe("stretched_layers.json", R"({"stretch": [2, 1, 1]})");
  const std::set<std::string> before = folder.names();
  Arguments arguments = refusal.arguments;
  arguments.insert(arguments.end(), {"--out", "x.vdb", "--quiet"});
  if (arguments.front() != "--on") arguments.insert(arguments.end(), {"--dim", "16"});
  expect_refusal(run_vdbnoise(arguments, {.folder = folder.path()}), refusal, "vdbnoise");
  EXPECT_EQ(folder.names(), before);
}

const Refusal kRefusals[] = {
    // Grids
    {"NoFile", 1, {"--raw", "--frequency-grid", "none.vdb"}, {"none.vdb: cannot be read"}},
    {"NotAVdb", 2, {"--raw", "--frequency-grid", "a.png"}, {"--frequency-grid is a.png", "FILE.vdb"}},
    {"NoSuchGrid",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:hol"},
     {"bad.vdb: has no grid of floats 'hol'; it has 'hole' (float), 'nan' (float)", "'mask' (bool)"}},
    {"BoolsForFloats", 1, {"--raw", "--frequency-grid", "bad.vdb:mask"}, {"no grid of floats 'mask'"}},
    {"VectorsForFloats", 1, {"--raw", "--bandwidth-grid", "painted.vdb:turn"}, {"'turn' (vec3s)"}},
    {"FloatsForVectors",
     1,
     {"--raw", "--direction-grid", "painted.vdb:ramp"},
     {"painted.vdb: has no grid of vectors 'ramp'; it has", "'turn' (vec3s)"}},
    {"NoActiveVoxels", 1, {"--raw", "--frequency-grid", "bad.vdb:empty"}, {"'empty' has no active voxels"}},
    {"OutOfRange",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:hole"},
     {"bad.vdb: grid 'hole' is -4 at voxel (1, 2, 3), and not allowed in 2 of its 2197 voxels; it must be "
      "greater than 0 (cycles per world unit); --frequency-map"}},
    {"TooWide",
     1,
     {"--raw", "--bandwidth-grid", "bad.vdb:wide"},
     {"grid 'wide' is 5", "2197 of its 2197 voxels", "between 0.1 and 4 (octaves)"}},
    {"Negative", 1, {"--raw", "--magnitude-grid", "bad.vdb:hole"}, {"is -4", "at least 0 (sigmas)"}},
    {"NotANumber",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:nan"},
     {"grid 'nan' is nan at voxel (-3, 0, 1), and not allowed in 1 of its 2197 voxels"}},
    {"NotANumberMapped",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:nan", "--frequency-map", "0", "1", "2", "3"},
     {"is nan at voxel (-3, 0, 1)", "it must be finite"}},
    // Where they lie
    {"DoesNotCoverTheVolume",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:half"},
     {"grid 'half' is 0 at voxel (-8, -8, -8) of the volume, and not allowed in", "of its 4096 voxels",
      "outside of its active voxels its background, 0, counts", "--frequency-map"}},
    {"LiesElsewhere",
     1,
     {"--raw", "--frequency-grid", "bad.vdb:far", "--frequency-map", "0", "1", "2", "3"},
     {"grid 'far' lies elsewhere than the volume: 7.25 to 10.25 and -1 to", "transforms disagree"}},
    // What has no effect, or does not go together
    {"MapWithoutGrid",
     2,
     {"--raw", "--frequency-map", "0", "1", "2", "3"},
     {"--frequency-map has no effect without --frequency-grid"}},
    {"MapOfOneValue",
     2,
     {"--raw", "--frequency-grid", "painted.vdb:ramp", "--frequency-map", "1", "1", "2", "3"},
     {"--frequency-map", "the two values of the grid must differ"}},
    {"MapToNothing",
     2,
     {"--raw", "--frequency-grid", "painted.vdb:ramp", "--frequency-map", "0", "1", "0", "3"},
     {"--frequency-map goes to 0; it must be greater than 0"}},
    {"Constant",
     2,
     {"--raw", "--frequency-grid", "painted.vdb:ramp", "--frequency", "3"},
     {"--frequency has no effect where --frequency-grid says it for each voxel"}},
    {"ConstantDirection",
     2,
     {"--raw", "--direction-grid", "painted.vdb:turn", "--noise", "gabor-oriented", "--direction", "1", "0",
      "0"},
     {"--direction has no effect where --direction-grid"}},
    {"Kensler",
     2,
     {"--raw", "--noise", "kensler", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with kensler noise; it must be gabor or gabor-oriented"}},
    {"DirectionOfGabor",
     2,
     {"--raw", "--noise", "gabor", "--direction-grid", "painted.vdb:turn"},
     {"--direction-grid needs waves of one direction: noise gabor-oriented of anisotropy 1"}},
    {"HalfAnisotropy",
     2,
     {"--raw", "--noise", "gabor-oriented", "--anisotropy", "0.5", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with an anisotropy of 0.5; it must be 0", "or 1"}},
    {"Evolves",
     2,
     {"--raw", "--evolve", "1", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with noise that evolves; dims 4"}},
    {"Period",
     2,
     {"--raw", "--period", "2", "2", "2", "--bandwidth-grid", "painted.vdb:narrow"},
     {"--bandwidth-grid does not go with noise that has a period"}},
    {"UniformWeights",
     2,
     {"--raw", "--weights", "uniform", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with uniform weights"}},
    {"BandLimit",
     2,
     {"--raw", "--band-limit", "--frequency-grid", "painted.vdb:ramp"},
     {"--band-limit is true; it must be false", "from a grid"}},
    {"Output",
     2,
     {"--output", "gradient", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid goes with output value only; output is gradient"}},
    {"MagnitudeOfAVelocity",
     2,
     {"--output", "curl", "--magnitude-grid", "painted.vdb:paint"},
     {"--magnitude-grid goes with output value only; output is curl"}},
    {"OtherLayers",
     2,
     {"--recipe", "other_layers.json", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid is of the recipe's noise; all layers have noises of their own"}},
    {"StretchedLayers",
     2,
     {"--recipe", "stretched_layers.json", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with layers that stretch"}},
    {"Rest",
     2,
     {"--on", "painted.vdb:paint", "--rest", "painted.vdb:turn", "--frequency-grid", "painted.vdb:ramp"},
     {"--frequency-grid does not go with rest"}},
    {"Frames",
     2,
     {"--raw", "--frequency-grid", "f.####.vdb"},
     {"--frequency-grid is", "f.####.vdb, which has a place for the number of a frame; give --frames"}},
};

INSTANTIATE_TEST_SUITE_P(Vdbnoise, BadParameters, testing::ValuesIn(kRefusals),
                         [](const auto& refusal) { return refusal.param.name; });

}  // namespace
}  // namespace solidnoise::parameter_test
