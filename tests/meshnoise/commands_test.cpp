#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "solidnoise/mesh/bake_recipe_json.h"

namespace solidnoise::commands_test {
namespace {

// Runs in a folder with a torus, in.ply, and expects it to go well.
ToolResult run_well(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  if (folder.names().count("in.ply") == 0) write_sample(folder, "in.ply", torus_with_numbers());
  const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  return result;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Meshnoise, DescribesInJsonAndWritesNothing) {
  const TemporaryFolder folder;
  const ToolResult result =
      run_well(folder, {"bake", "in.ply", "--describe", "--out", "x.ply", "--write-recipe", "x.json",
                        "--frequency", "2..8", "--by", "heat", "--seed", "5"});
  const Json json = parse_json(result.out);
  EXPECT_EQ(json["mesh"]["vertices"], torus_with_numbers().positions.size());
  EXPECT_EQ(json["mesh"]["new_vertices"], 0);
  EXPECT_FLOAT_EQ(json["noise"]["frequency"]["least"].get<float>(), 2.0f);
  EXPECT_FLOAT_EQ(json["noise"]["frequency"]["most"].get<float>(), 8.0f);
  EXPECT_GT(json["noise"]["highest_frequency"].get<double>(), 8.0);
  EXPECT_LE(json["noise"]["kernel"]["excess_kurtosis"].get<double>(), 0.5);
  EXPECT_EQ(json["steering"]["least"], 0.0);
  EXPECT_EQ(json["steering"]["most"], 1.0);
  EXPECT_EQ(bake_recipe_from_json(json["recipe"]).noise.seed, 5u);
  EXPECT_EQ(folder.names(), std::set<std::string>{"in.ply"});
}

TEST(Meshnoise, ReadsAPlyFromTheStandardInput) {
  const TemporaryFolder folder;
  const std::string info = run_well(folder, {"info", "in.ply"}).out;
  run_well(folder, {"bake", "in.ply", "--out", "file.ply"});
  const auto piped = [&](const std::string& file, const std::string& arguments) {
    const std::string command = "cat " + file + " | " + in_build("tools/meshnoise") + " " + arguments;
    return RunningTool("/bin/sh", {"-c", command}, {.folder = folder.path()}).wait();
  };
  EXPECT_EQ(piped("in.ply", "info -").out, info);
  const ToolResult baked = piped("in.ply", "bake - --out piped.ply");
  ASSERT_EQ(baked.status, 0) << baked.err;
  EXPECT_EQ(folder.read("piped.ply"), folder.read("file.ply"));
  const ToolResult empty = piped("/dev/null", "info -");
  EXPECT_EQ(empty.status, 1);
  EXPECT_EQ(empty.err, "meshnoise: -: the file is empty\n");
}

TEST(Meshnoise, DescribesWhatRefinementReaches) {
  const TemporaryFolder folder;
  const ToolResult result = run_well(
      folder, {"bake", "in.ply", "--describe", "--frequency", "5", "--octaves", "1", "--refine", "auto"});
  const Json json = parse_json(result.out);
  EXPECT_GT(json["mesh"]["new_vertices"].get<int>(), 0);
  EXPECT_LE(json["noise"]["mean_cycles_per_edge"].get<double>(), 0.5);
}

TEST(Meshnoise, EveryPresetIsListedAndBakes) {
  const TemporaryFolder folder;
  const ToolResult list = run_well(folder, {"--list-presets"});
  EXPECT_EQ(run_well(folder, {"bake", "--list-presets"}).out, list.out);
  for (const std::string preset : {"rust", "scales", "bark", "stone", "skin", "moss", "car-paint"}) {
    EXPECT_TRUE(contains(list.out, preset + " ")) << list.out;
    run_well(folder, {"bake", "in.ply", "--preset", preset, "--out", preset + ".ply"});
    const PolygonMesh baked = read_mesh(folder.file(preset + ".ply")).mesh;
    EXPECT_GT(spread(numbers_of(baked, "noise")), 1.0) << preset;
    EXPECT_GT(spread(numbers_of(baked, "red")), 20.0) << preset;
  }
}

TEST(Meshnoise, WritesARecipeWithoutBaking) {
  const TemporaryFolder folder;
  const ToolResult to_file =
      run_well(folder, {"bake", "in.ply", "--write-recipe", "x.json", "--preset", "bark", "--seed", "9"});
  EXPECT_EQ(to_file.err, "");
  const ToolResult to_stream =
      run_well(folder, {"bake", "in.ply", "--write-recipe", "-", "--preset", "bark", "--seed", "9"});
  EXPECT_EQ(to_stream.out, folder.read("x.json"));
  const BakeRecipe recipe = bake_recipe_from_json(parse_json(to_stream.out));
  EXPECT_EQ(recipe.noise.seed, 9u);
  EXPECT_EQ(recipe.noise.kind, SurfaceNoiseKind::oriented);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.ply", "x.json"}));
}

TEST(Meshnoise, PreviewIsAPicture) {
  if (!SOLIDNOISE_PREVIEWS) GTEST_SKIP() << "built without Embree";
  const TemporaryFolder folder;
  run_well(folder, {"curvature", "in.ply", "--preview", "alone.png"});
  EXPECT_EQ(folder.read("alone.png").substr(1, 3), "PNG");
  run_well(folder, {"bake", "in.ply", "--preview", "beside.png", "--out", "x.ply"});
  EXPECT_EQ(folder.read("beside.png").substr(1, 3), "PNG");
  EXPECT_FALSE(folder.read("alone.png") == folder.read("beside.png"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.ply", "alone.png", "beside.png", "x.ply"}));
}

TEST(Meshnoise, ReplacesFilesWithForceOnly) {
  const TemporaryFolder folder;
  folder.write("x.ply", "old");
  folder.write("x.json", "old");
  run_well(folder, {"bake", "in.ply", "--out", "x.ply", "--write-recipe", "x.json", "--force"});
  EXPECT_TRUE(folder.read("x.ply").starts_with("ply\n"));
  EXPECT_TRUE(folder.read("x.json").starts_with("{"));
}

TEST(Meshnoise, ShowsItsProgressOnATerminalUnlessQuiet) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  const RunOptions on_terminal{.folder = folder.path(), .on_terminal = true};
  const ToolResult shown = run_meshnoise({"bake", "in.ply", "--out", "a.ply"}, on_terminal);
  EXPECT_EQ(shown.status, 0);
  EXPECT_TRUE(contains(shown.err, " %")) << shown.err;
  EXPECT_TRUE(contains(shown.err, "sigma")) << shown.err;
  for (const std::string command : {"bake", "curvature"}) {
    const ToolResult quiet =
        run_meshnoise({command, "in.ply", "--out", command + ".ply", "--quiet"}, on_terminal);
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.err, "");
  }
}

TEST(Meshnoise, WarnsOfAliasing) {
  const TemporaryFolder folder;
  EXPECT_FALSE(contains(
      run_well(folder, {"bake", "in.ply", "--out", "a.ply", "--detail", "0.1", "--octaves", "1"}).err,
      "warning"));
  const ToolResult coarse = run_well(folder, {"bake", "in.ply", "--out", "b.ply", "--frequency", "100"});
  EXPECT_TRUE(contains(coarse.err, "cycles per edge")) << coarse.err;
  EXPECT_TRUE(contains(coarse.err, "million vertices") && contains(coarse.err, "use --refine auto"))
      << coarse.err;
  const ToolResult limited = run_well(folder, {"bake", "in.ply", "--out", "c.ply", "--frequency", "100",
                                               "--refine", "auto", "--refine-budget", "2000"});
  EXPECT_TRUE(contains(limited.err, "raise --refine-budget")) << limited.err;
}

// The mean curvature of a torus of radii 1 and 0.4 is 0.5 (1 / 0.4 + cos / (1 + 0.4 cos)), from 0.42 to 1.61.
TEST(Meshnoise, CurvatureIsInNumbersAndColors) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", torus_mesh(1.0, 0.4, {.n = 40}));
  const std::string stream =
      run_well(folder, {"curvature", "in.ply", "--out", "-", "--by", "height", "--smooth", "0"}).out;
  run_well(folder, {"curvature", "in.ply", "--out", "x.ply", "--by", "height", "--smooth", "0"});
  EXPECT_TRUE(stream == folder.read("x.ply"));
  const PolygonMesh mesh = read_mesh(folder.file("x.ply")).mesh;
  const std::vector<double> mean = numbers_of(mesh, "mean_curvature");
  ASSERT_EQ(mean.size(), mesh.positions.size());
  const auto [least, most] = std::minmax_element(mean.begin(), mean.end());
  EXPECT_NEAR(*least, 0.4167, 0.05);
  EXPECT_NEAR(*most, 1.6071, 0.05);
  for (const char* name : {"gaussian_curvature", "k1", "k2"}) EXPECT_NE(mesh.property(name), nullptr);
  std::vector<std::size_t> by_height(mean.size());
  for (std::size_t v = 0; v < by_height.size(); ++v) by_height[v] = v;
  std::sort(by_height.begin(), by_height.end(),
            [&](std::size_t a, std::size_t b) { return mesh.positions[a].y < mesh.positions[b].y; });
  const std::vector<double> green = numbers_of(mesh, "green");  // viridis: the higher, the greener
  for (std::size_t i = 1; i < by_height.size(); ++i) ASSERT_GE(green[by_height[i]], green[by_height[i - 1]]);
}

TEST(Meshnoise, InfoPrintsTheMeshAndItsRecipe) {
  const TemporaryFolder folder;
  run_well(folder, {"bake", "in.ply", "--out", "x.ply", "--seed", "12345"});
  const std::string info = run_well(folder, {"info", "x.ply"}).out;
  const std::string count = std::to_string(torus_with_numbers().positions.size());
  for (const std::string& word : {count + " vertices", std::string("closed"), std::string("mean edge"),
                                  std::string("heat"), std::string("noise"), std::string("\"seed\":12345")}) {
    EXPECT_TRUE(contains(info, word)) << word << " is not in " << info;
  }
  folder.write("plane.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string open = run_well(folder, {"info", "plane.obj"}).out;
  EXPECT_TRUE(contains(open, "open") && contains(open, "3 edges at a boundary")) << open;
}

TEST(Meshnoise, HelpListsTheFlags) {
  const ToolResult result = run_meshnoise({"bake", "--help-all"});
  ASSERT_EQ(result.status, 0);
  for (const char* flag : {"--out", "--noise", "--frequency", "--by", "--ramp", "--refine", "--displace",
                           "--follow", "--preview", "--recipe", "--describe", "--threads"}) {
    EXPECT_TRUE(contains(result.out, flag)) << flag;
  }
  for (const char* command : {"bake", "curvature", "info"}) {
    EXPECT_TRUE(contains(run_meshnoise({"--help"}).out, command));
    EXPECT_TRUE(contains(run_meshnoise({command, "--help"}).out, std::string("meshnoise ") + command));
  }
  EXPECT_TRUE(run_meshnoise({"--version"}).out.starts_with("meshnoise "));
}

}  // namespace
}  // namespace solidnoise::commands_test
