#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::vdbnoise_test {
namespace {

VolumeRecipe recipe_in(const std::string& file) {
  return volume_recipe_from_json(parse_json(read_vdb_summary(file).grids[0].metadata.at(kRecipeKey)));
}

void run_well(std::vector<std::string> arguments) {
  arguments.push_back("--quiet");
  const ToolResult result = run_vdbnoise(arguments);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

TEST(Vdbnoise, RecipeOfAVolumeMakesTheSameGridAgain) {
  const std::vector<std::vector<std::string>> cases{
      {"--dim", "40", "--octaves", "2"},
      {"--raw", "--dim", "24", "--frequency", "3.3", "--seed", "18446744073709551615", "--half"},
      {"--raw", "--voxel", "0.1", "--noise", "kensler", "--range", "unit", "--codec", "none"},
      {"--raw", "--dim", "20", "--noise", "gabor-oriented", "--anisotropy", "0.7", "--octaves", "2"},
      {"--preset", "nebula", "--dim", "20", "--octaves", "1", "--dims", "4", "--time", "0.3", "--grid",
       "stone", "--up", "z"},
  };
  for (std::vector<std::string> arguments : cases) {
    const TemporaryFolder folder;
    arguments.insert(arguments.end(),
                     {"--out", folder.file("a.vdb"), "--write-recipe", folder.file("a.json")});
    run_well(arguments);
    run_well({"--recipe", folder.file("a.vdb"), "--out", folder.file("b.vdb")});
    run_well({"--recipe", folder.file("a.json"), "--out", folder.file("c.vdb"), "--threads", "1"});
    expect_same_grid(folder.file("a.vdb"), folder.file("b.vdb"));
    expect_same_grid(folder.file("a.vdb"), folder.file("c.vdb"));
  }
}

TEST(Vdbnoise, FlagsOverrideTheRecipeAndNothingElse) {
  const TemporaryFolder folder;
  run_well({"--raw", "--dim", "16", "--frequency", "5", "--out", folder.file("a.vdb")});
  run_well({"--recipe", folder.file("a.vdb"), "--seed", "7", "--out", folder.file("b.vdb")});
  VolumeRecipe expected = recipe_in(folder.file("a.vdb"));
  std::get<GaborNoiseOptions>(expected.noise.noise).seed = 7;
  EXPECT_EQ(to_json(recipe_in(folder.file("b.vdb"))), to_json(expected));
}

TEST(Vdbnoise, CloudsHaveFlagsOfTheirOwn) {
  const TemporaryFolder folder;
  run_well({"--dim", "16", "--puffs", "9", "--lobes", "0.2", "--base", "0.3", "--cloud-edge", "0.2",
            "--wisps", "0.5", "--core", "0.4", "--lean", "0", "--out", folder.file("a.vdb")});
  const CloudShaping expected{
      .puffs = 9, .lobes = 0.2, .base = 0.3, .edge = 0.2, .wisps = 0.5, .core = 0.4, .lean = 0.0};
  EXPECT_EQ(std::get<CloudShaping>(recipe_in(folder.file("a.vdb")).shaping), expected);
}

// On one lattice for all boxes: centres are whole multiples of the voxel size, from a box's lower sides on.
TEST(Vdbnoise, FillsABoxFromItsLowerSides) {
  const TemporaryFolder folder;
  const auto bounds_of = [&](std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--out", folder.file("x.vdb"), "--force"});
    run_well(flags);
    const auto grid = read_float_grid(folder.file("x.vdb"));
    EXPECT_EQ(grid->indexToWorld(openvdb::Vec3d(0.0)), openvdb::Vec3d(0.0));
    return grid->evalActiveVoxelBoundingBox();
  };
  using Bounds = openvdb::CoordBBox;
  EXPECT_EQ(bounds_of({"--raw", "--dim", "32"}), Bounds({-16, -16, -16}, {15, 15, 15}));
  EXPECT_EQ(bounds_of({"--raw", "--dim", "20", "--box", "0", "0", "0", "2", "1", "1"}),
            Bounds({0, 0, 0}, {19, 9, 9}));
  // Of a sphere of 16 voxels' radius the centres at 16 are on the surface, and half covered.
  EXPECT_EQ(bounds_of({"--preset", "marble", "--shape", "sphere", "--box", "-1", "-1", "-1", "1", "1", "1",
                       "--dim", "32"}),
            Bounds({-16, -16, -16}, {16, 16, 16}));
}

// The recipe in the file names the generator that was taken, whatever is cheaper in another version.
TEST(Vdbnoise, TakesTheCheaperGenerator) {
  const TemporaryFolder folder;
  run_well({"--raw", "--dim", "16", "--seed", "5", "--generator", "auto", "--out", folder.file("a.vdb")});
  run_well(
      {"--raw", "--dim", "16", "--seed", "5", "--noise", "gabor-oriented", "--out", folder.file("b.vdb")});
  expect_same_grid(folder.file("a.vdb"), folder.file("b.vdb"));
  run_well({"--raw", "--dim", "16", "--generator", "auto", "--noise", "gabor-oriented", "--bandwidth", "4",
            "--out", folder.file("c.vdb")});
  EXPECT_TRUE(std::holds_alternative<GaborNoiseOptions>(recipe_in(folder.file("c.vdb")).noise.noise));
}

TEST(Vdbnoise, FilesThatFollowTheRecipeFileAreFoundFromAnyFolder) {
  const TemporaryFolder folder;
  folder.write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const ToolResult made = run_vdbnoise(
      {"--raw", "--shape", "tetrahedron.obj", "--dim", "24", "--out", "a.vdb"}, {.folder = folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  run_well({"--recipe", folder.file("a.vdb"), "--out", folder.file("b.vdb")});
  expect_same_grid(folder.file("a.vdb"), folder.file("b.vdb"));
  run_well({"--raw", "--shape", folder.file("a.vdb:density"), "--seed", "3", "--out", folder.file("c.vdb")});
  EXPECT_TRUE(read_float_grid(folder.file("a.vdb"))
                  ->tree()
                  .hasSameTopology(read_float_grid(folder.file("c.vdb"))->tree()));
}

TEST(Vdbnoise, ABoxCutInTwoHoldsTheSameNoise) {
  const TemporaryFolder folder;
  const std::vector<std::string> common{"--raw", "--voxel", "0.1", "--frequency", "1.3"};
  const auto make = [&](const std::string& name, std::vector<std::string> box) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--out", folder.file(name), "--box"});
    arguments.insert(arguments.end(), box.begin(), box.end());
    run_well(arguments);
    return read_float_grid(folder.file(name));
  };
  const auto whole = make("whole.vdb", {"-2", "-1", "-1", "2", "1", "1"});
  const auto left = make("left.vdb", {"-2", "-1", "-1", "0.3", "1", "1"});
  const auto right = make("right.vdb", {"0.3", "-1", "-1", "2", "1", "1"});
  EXPECT_EQ(left->activeVoxelCount() + right->activeVoxelCount(), whole->activeVoxelCount());
  for (const auto& part : {left, right}) {
    for (auto value = part->cbeginValueOn(); value; ++value) {
      ASSERT_EQ(*value, whole->tree().getValue(value.getCoord())) << value.getCoord();
    }
  }
}

TEST(Vdbnoise, DensityIsScaledToTheDepthOrThePeakThatIsAskedFor) {
  const TemporaryFolder folder;
  run_well({"--dim", "32", "--octaves", "2", "--optical-depth", "12", "--out", folder.file("depth.vdb")});
  run_well({"--dim", "32", "--octaves", "2", "--density", "3", "--out", folder.file("peak.vdb")});
  run_well({"--dim", "32", "--octaves", "2", "--optical-depth", "12", "--up", "z", "--out",
            folder.file("up.vdb")});
  const double tolerance = 1e-5;  // a few dozen roundings to single precision
  EXPECT_NEAR(thickest_column(*read_float_grid(folder.file("depth.vdb")), 1), 12.0, 12.0 * tolerance);
  EXPECT_NEAR(thickest_column(*read_float_grid(folder.file("up.vdb")), 2), 12.0, 12.0 * tolerance);
  EXPECT_NEAR(measure(*read_float_grid(folder.file("peak.vdb"))).max(), 3.0, 3.0 * tolerance);
}

TEST(Vdbnoise, GridsAreWhatReadersExpect) {
  const TemporaryFolder folder;
  run_well({"--dim", "24", "--octaves", "2", "--out", folder.file("cloud.vdb")});
  run_well({"--dim", "24", "--octaves", "2", "--half", "--grid", "fog", "--codec", "zip", "--out",
            folder.file("half.vdb")});
  const auto grid = read_float_grid(folder.file("cloud.vdb"));
  EXPECT_EQ(grid->getName(), "density");
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(grid->background(), 0.0f);
  EXPECT_GE(measure(*grid).min(), 0.0);
  EXPECT_EQ(grid->metaValue<std::string>("solidnoise:up_axis"), "y");
  const GridSummary half = read_vdb_summary(folder.file("half.vdb")).grids[0];
  EXPECT_EQ(half.name, "fog");
  EXPECT_TRUE(half.saved_as_half);
}

// Two voxels along x and minus one along z: what was at a voxel is there now. All lengths are exact in
// binary, and so are the values.
TEST(Vdbnoise, OffsetMovesTheNoiseAndIsInTheRecipe) {
  for (const std::vector<std::string>& dims :
       {std::vector<std::string>{"--dims", "3"}, {"--dims", "4", "--time", "0.25"}}) {
    const TemporaryFolder folder;
    std::vector<std::string> flags{"--raw", "--frequency", "2", "--voxel", "0.125"};
    flags.insert(flags.end(), dims.begin(), dims.end());
    const auto make = [&](const std::string& name, const std::vector<std::string>& more) {
      std::vector<std::string> arguments = flags;
      arguments.insert(arguments.end(), more.begin(), more.end());
      arguments.insert(arguments.end(), {"--out", folder.file(name)});
      run_well(arguments);
      return read_float_grid(folder.file(name));
    };
    const auto still = make("still.vdb", {});
    const auto moved = make("moved.vdb", {"--offset", "0.25", "0", "-0.125"});
    int compared = 0;
    for (auto value = moved->cbeginValueOn(); value; ++value) {
      const openvdb::Coord from = value.getCoord() - openvdb::Coord(2, 0, -1);
      if (!still->tree().isValueOn(from)) continue;
      ASSERT_EQ(*value, still->tree().getValue(from)) << value.getCoord();
      ++compared;
    }
    EXPECT_GT(compared, 1000);
    EXPECT_EQ(recipe_in(folder.file("moved.vdb")).offset, Vec<3>(0.25, 0.0, -0.125));
    run_well({"--recipe", folder.file("moved.vdb"), "--out", folder.file("again.vdb")});
    expect_same_grid(folder.file("moved.vdb"), folder.file("again.vdb"));
  }
}

TEST(Vdbnoise, RefusesARecipeWhoseFileChanged) {
  const TemporaryFolder folder;
  run_well({"--raw", "--dim", "12", "--out", folder.file("shape.vdb")});
  const std::string shape = folder.file("shape.vdb");
  run_well({"--raw", "--shape", shape, "--seed", "1", "--out", folder.file("a.vdb"), "--write-recipe",
            folder.file("a.json")});
  run_well({"--recipe", folder.file("a.vdb"), "--out", folder.file("b.vdb")});
  expect_same_grid(folder.file("a.vdb"), folder.file("b.vdb"));

  run_well({"--raw", "--dim", "13", "--force", "--out", shape});
  for (const std::string recipe : {"a.vdb", "a.json"}) {
    const ToolResult refused = run_vdbnoise({"--recipe", folder.file(recipe), "--out", folder.file("c.vdb")});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("shape.vdb: is not the file that the recipe was made with"), std::string::npos)
        << refused.err;
  }
  run_well({"--recipe", folder.file("a.vdb"), "--shape", shape, "--out", folder.file("c.vdb")});
}

TEST(Vdbnoise, WritesARecipeWithoutMakingItsVolume) {
  const TemporaryFolder folder;
  const ToolResult result =
      run_vdbnoise({"--raw", "--dim", "100000", "--write-recipe", folder.file("a.json")});
  EXPECT_EQ(result.status, 0) << "more voxels than fit into memory: " << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(volume_recipe_from_json(parse_json(folder.read("a.json"))).dim, 100000);
}

TEST(Vdbnoise, EveryPresetIsListedAndMakesAVolume) {
  const ToolResult list = run_vdbnoise({"--list-presets"});
  EXPECT_EQ(list.status, 0);
  for (const std::string preset : {"cumulus", "smoke", "nebula", "marble", "raw"}) {
    EXPECT_NE(list.out.find(preset + " "), std::string::npos) << list.out;
    const TemporaryFolder folder;
    run_well({"--preset", preset, "--dim", "32", "--octaves", "2", "--out", folder.file("x.vdb")});
    const std::string grid = preset == "marble" ? "vein" : "density";
    const Moments moments = measure(*read_float_grid(folder.file("x.vdb"), grid));
    EXPECT_GT(moments.count(), 1000u) << preset;
    EXPECT_GT(moments.sigma(), 0.0) << preset;
  }
}

TEST(Vdbnoise, DescribesInJsonAndWritesNothing) {
  const TemporaryFolder folder;
  const ToolResult result =
      run_vdbnoise({"--describe", "--raw", "--dim", "64", "--out", "x.vdb", "--preview", "x.png"},
                   {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = parse_json(result.out);
  EXPECT_NEAR(json["noise"]["variance"].get<double>(), 1.0, 1e-6);
  EXPECT_LE(json["noise"]["excess_kurtosis"].get<double>(), 0.5);
  EXPECT_EQ(json["grid"]["voxels_at_most"], 64 * 64 * 64);
  EXPECT_GE(json["grid"]["memory_at_most_bytes"].get<double>(), 64.0 * 64.0 * 64.0 * 4.0);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Vdbnoise, DescribesTheGridThatIsWorkedOn) {
  const TemporaryFolder folder;
  run_well({"--preset", "fire", "--dim", "16", "--out", folder.file("f.vdb")});
  const ToolResult result = run_vdbnoise({"--describe", "--on", folder.file("f.vdb:temperature")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(parse_json(result.out)["grids"], Json::array({{{"name", "temperature"}, {"components", 1}}}));
}

TEST(Vdbnoise, DescribesWhatAPartTakes) {
  const auto described = [](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"--describe", "--raw", "--dim", "320"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return parse_json(run_vdbnoise(arguments).out);
  };
  const auto bytes = [](const Json& json) { return json["grid"]["memory_at_most_bytes"].get<double>(); };
  const auto seconds = [](const Json& json) { return json["cost"]["seconds_of_one_core"].get<double>(); };
  const Json whole = described({});
  for (const std::vector<std::string>& flags :
       {std::vector<std::string>{"--shard", "1/8"}, {"--region", "-1", "-1", "-1", "0", "0", "0"}}) {
    // An eighth, and what every part has: its share of the topology, the impulses around blocks.
    const Json part = described(flags);
    EXPECT_LT(bytes(part), 0.25 * bytes(whole));
    EXPECT_LT(seconds(part), 0.25 * seconds(whole));
  }
}

// The impulses between voxels that are many waves apart take no time.
TEST(Vdbnoise, DescribesVoxelsFarApartByTheImpulsesAroundThem) {
  const auto seconds = [](const std::string& side) {
    const ToolResult described =
        run_vdbnoise({"--describe", "--raw", "--box", "0", "0", "0", side, side, side, "--dim", "32"});
    return parse_json(described.out)["cost"]["seconds_of_one_core"].get<double>();
  };
  EXPECT_LT(seconds("1000"), 1.5 * seconds("40"));
  EXPECT_LT(seconds("1e6"), 3.0 * seconds("40"));
}

// Those between which many cells of gradients or points lie share none, and take more time.
TEST(Vdbnoise, DescribesTheCellsThatVoxelsDoNotShare) {
  for (const char* noise : {"kensler", "cellular"}) {
    const auto seconds = [&](const char* frequency) {
      const ToolResult described =
          run_vdbnoise({"--describe", "--raw", "--noise", noise, "--frequency", frequency, "--dim", "160"});
      return parse_json(described.out)["cost"]["seconds_of_one_core"].get<double>();
    };
    EXPECT_GT(seconds("1000"), 10.0 * seconds("8")) << noise;
    EXPECT_EQ(seconds("1000"), seconds("10000")) << noise;
  }
}

TEST(Vdbnoise, ShapesStandOnTheUpAxis) {
  const auto box_of = [](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"--describe", "--dim", "16"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return parse_json(run_vdbnoise(arguments).out)["recipe"]["domain"]["box"].get<std::vector<double>>();
  };
  const std::vector<double> y_up = box_of({});
  const std::vector<double> z_up = box_of({"--up", "z"});
  EXPECT_EQ(z_up, (std::vector<double>{y_up[0], -y_up[5], y_up[1], y_up[3], -y_up[2], y_up[4]}));
  EXPECT_EQ(box_of({"--up", "z", "--box", "0", "0", "0", "1", "2", "3"}),
            (std::vector<double>{0, 0, 0, 1, 2, 3}));
}

TEST(Vdbnoise, StandardOutputCarriesTheVolumeAndNothingElse) {
  const TemporaryFolder folder;
  const std::vector<std::string> common{"--raw", "--dim", "24"};
  std::vector<std::string> to_stream = common;
  to_stream.insert(to_stream.end(), {"--out", "-"});
  const ToolResult streamed = run_vdbnoise(to_stream);
  ASSERT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_EQ(streamed.err.find('\r'), std::string::npos) << "a progress bar without a terminal";
  folder.write("streamed.vdb", streamed.out);
  std::vector<std::string> to_file = common;
  to_file.insert(to_file.end(), {"--out", folder.file("file.vdb")});
  run_well(to_file);
  expect_same_grid(folder.file("file.vdb"), folder.file("streamed.vdb"));
}

TEST(Vdbnoise, ShowsItsProgressOnATerminalUnlessQuiet) {
  const TemporaryFolder folder;
  const RunOptions on_terminal{.folder = folder.path(), .on_terminal = true};
  const ToolResult shown = run_vdbnoise({"--raw", "--dim", "64", "--out", "a.vdb"}, on_terminal);
  EXPECT_EQ(shown.status, 0);
  EXPECT_NE(shown.err.find(" %"), std::string::npos) << shown.err;
  EXPECT_NE(shown.err.find("sigma"), std::string::npos) << shown.err;
  const ToolResult quiet = run_vdbnoise({"--raw", "--dim", "64", "--out", "b.vdb", "--quiet"}, on_terminal);
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.err, "");
}

TEST(Vdbnoise, PrintsStatisticsAndWarnsOfAliasing) {
  const TemporaryFolder folder;
  const ToolResult fine =
      run_vdbnoise({"--raw", "--frequency", "1", "--dim", "32", "--out", folder.file("fine.vdb")});
  for (const char* word : {"32768 active voxels", "32 x 32 x 32", "min", "max", "mean", "sigma", "0.0625"}) {
    EXPECT_NE(fine.err.find(word), std::string::npos) << fine.err;
  }
  EXPECT_EQ(fine.err.find("warning"), std::string::npos) << fine.err;
  const ToolResult coarse =
      run_vdbnoise({"--raw", "--frequency", "8", "--dim", "32", "--out", folder.file("coarse.vdb")});
  EXPECT_EQ(coarse.status, 0);
  EXPECT_NE(coarse.err.find("cycles per voxel"), std::string::npos) << coarse.err;
}

TEST(Vdbnoise, InfoPrintsGridsAndTheRecipe) {
  const TemporaryFolder folder;
  run_well({"--raw", "--dim", "16", "--seed", "12345", "--out", folder.file("a.vdb")});
  const ToolResult result = run_vdbnoise({"info", folder.file("a.vdb")});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* word :
       {"grid density", "float", "4096 active voxels", "\"seed\": 12345", "creator = vdbnoise"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << result.out;
  }
}

TEST(Vdbnoise, PreviewIsAPicture) {
  const TemporaryFolder folder;
  run_well(
      {"--dim", "32", "--octaves", "2", "--out", folder.file("a.vdb"), "--preview", folder.file("a.png")});
  EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.vdb", "a.png"}));
}

TEST(Vdbnoise, HelpListsTheFlags) {
  const ToolResult result = run_vdbnoise({"--help-all"});
  ASSERT_EQ(result.status, 0);
  for (const char* flag : {"--out", "--noise", "--voxel", "--optical-depth", "--recipe", "--max-memory"}) {
    EXPECT_NE(result.out.find(flag), std::string::npos);
  }
}

// What reads and writes images takes most of a second to load; it is loaded by those who need it. The loader
// lists here what the program starts with.
TEST(Vdbnoise, StartsWithoutTheLibrariesOfImages) {
  setenv("LD_TRACE_LOADED_OBJECTS", "1", 1);
  const ToolResult result = run_vdbnoise({"--help"});
  unsetenv("LD_TRACE_LOADED_OBJECTS");
  EXPECT_NE(result.out.find("libopenvdb"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("OpenImageIO"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace solidnoise::vdbnoise_test
