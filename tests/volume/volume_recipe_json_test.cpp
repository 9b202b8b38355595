#include "solidnoise/volume/volume_recipe_json.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json_reader.h"
#include "support/paths.h"

namespace solidnoise::volume_recipe_json_test {
namespace {

std::string message_of(const std::string& text) {
  try {
    volume_recipe_from_json(parse_json(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

// Equal JSON is equal data: every field is in it, and numbers are written so that they read back exactly.
void expect_round_trip(const VolumeRecipe& recipe) {
  const std::string text = format_json(to_json(recipe));
  EXPECT_EQ(format_json(to_json(volume_recipe_from_json(parse_json(text)))), text);
}

TEST(VolumeRecipeJson, RoundTripsEveryShapeAndShaping) {
  for (const Shape& shape :
       {Shape(BoxShape{}), Shape(SphereShape{}), Shape(EllipsoidShape{}), Shape(MeshShape{"a \"b\".obj"}),
        Shape(MeshShape{"a.obj", "0123456789abcdef"}), Shape(GridShape{"in.vdb", "heat"}),
        Shape(GridShape{"in.vdb", {}, "0123456789abcdef"})}) {
    VolumeRecipe recipe;
    recipe.shape = shape;
    recipe.voxel = 0.1 + 0.2;
    recipe.box = {{-1.0 / 3.0, 0.0, 1e-9}, {1.0, 2.0, 3.0}};
    expect_round_trip(recipe);
    EXPECT_EQ(volume_recipe_from_json(to_json(recipe)).shape, shape);
  }
  for (const Shaping& shaping : {Shaping(RawShaping{RawShaping::Range::unit}),
                                 Shaping(RemapShaping{RemapShaping::Fold::ridged, -0.3, 0.7, 2.5, 1.0, 0.1}),
                                 Shaping(VeinShaping{{0.1, -2.0, 3.0}, 0.7, 1.5, 2.5, 0.1}),
                                 Shaping(CloudShaping{5, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6})}) {
    VolumeRecipe recipe;
    recipe.shaping = shaping;
    recipe.density.peak = 2.5;
    expect_round_trip(recipe);
    EXPECT_EQ(volume_recipe_from_json(to_json(recipe)).shaping, shaping);
  }
}

TEST(VolumeRecipeJson, RoundTripsWhatIsNotTheDefault) {
  VolumeRecipe recipe;
  recipe.description = "two\nlines";
  recipe.noise.noise = GradientNoiseOptions{.frequency = 0.7, .seed = ~0ULL};
  recipe.dims = 4;
  recipe.time = -1.25;
  recipe.density.optical_depth = 1.0 / 7.0;
  recipe.density.factor = 1.0 / 3.0;
  recipe.dim = 99;
  recipe.up = UpAxis::z;
  recipe.grid = "smoke";
  recipe.half = true;
  recipe.codec = Codec::none;
  expect_round_trip(recipe);
  const VolumeRecipe back = volume_recipe_from_json(to_json(recipe));
  EXPECT_EQ(back.noise, recipe.noise);
  EXPECT_EQ(back.density, recipe.density);
  EXPECT_EQ(back.time, recipe.time);
  EXPECT_EQ(back.description, recipe.description);
}

TEST(VolumeRecipeJson, RoundTripsTimeAndBandLimitOfNoiseThatEvolves) {
  VolumeRecipe recipe;
  recipe.noise.noise = OrientedGaborNoiseOptions{.evolution = {.rate = 0.1 + 0.2, .loop = 7.0 / 3.0}};
  recipe.time = 1.0 / 3.0;
  recipe.band_limit = true;
  expect_round_trip(recipe);
  const VolumeRecipe back = volume_recipe_from_json(to_json(recipe));
  EXPECT_EQ(back.noise, recipe.noise);
  EXPECT_EQ(back.time, recipe.time);
  EXPECT_TRUE(back.band_limit);
}

TEST(VolumeRecipeJson, RoundTripsOutputs) {
  VolumeRecipe velocity;
  velocity.output = {Output::curl};
  velocity.speed = 1.0 / 3.0;
  velocity.boundary = GridFile{"rock.vdb", "surface", "0123456789abcdef"};
  velocity.boundary_width = 0.1;
  expect_round_trip(velocity);
  const VolumeRecipe back = volume_recipe_from_json(to_json(velocity));
  EXPECT_EQ(back.output, velocity.output);
  EXPECT_EQ(back.speed, velocity.speed);
  EXPECT_EQ(back.boundary, velocity.boundary);
  EXPECT_EQ(back.boundary_width, velocity.boundary_width);
  EXPECT_EQ(grid_names(back), std::vector<std::string>{"vel"});

  VolumeRecipe both;
  both.output = {Output::gradient, Output::value};
  expect_round_trip(both);
  EXPECT_EQ(volume_recipe_from_json(to_json(both)).output, both.output);
  EXPECT_EQ(grid_names(both), (std::vector<std::string>{"gradient", "density"}));

  const Json plain = to_json(VolumeRecipe{}).at("grids").at(0);
  EXPECT_EQ(plain.at("name"), "density");
  for (const char* key : {"output", "speed", "boundary"}) EXPECT_FALSE(plain.contains(key)) << key;
}

constexpr char kSeveral[] = R"({
  "solidnoise": 2, "noise": {"type": "gabor", "seed": 7},
  "fields": {"body": {"fold": "billow", "stretch": [1, 2, 1]}, "both": {"use": "body", "weight": 2}},
  "grids": [
    {"name": "density", "layers": [{"use": "both"}, {"place": "radius"}], "shaping": {"type": "remap"},
     "scale": {"peak": 3}},
    {"name": "heat", "noise": {"type": "kensler", "frequency": 3}, "sparse": true, "half": true},
    {"name": "vel", "output": "curl", "drift": [0, 1, 0], "within": {"use": "body", "ramp": [[0, 0], [1, 1]]}}
  ],
  "domain": {"shape": {"type": "sphere"}, "dim": 40}
})";

TEST(VolumeRecipeJson, RoundTripsSeveralGrids) {
  const VolumeRecipe recipe = volume_recipe_from_json(parse_json(kSeveral));
  EXPECT_EQ(grid_names(recipe), (std::vector<std::string>{"density", "heat", "vel"}));
  expect_round_trip(recipe);
  const VolumeRecipe back = volume_recipe_from_json(to_json(recipe));
  EXPECT_EQ(back.grids, recipe.grids);
  EXPECT_EQ(back.fields, recipe.fields);
  EXPECT_EQ(recipe_of_grid(back, "vel").drift, Vec<3>(0.0, 1.0, 0.0));
  EXPECT_EQ(recipe_of_grid(back, "density").density.peak, 3.0);
}

// The list of a single grid is what the short form was read as, and it is what is written.
TEST(VolumeRecipeJson, ReadsTheShortFormAsAListOfOneGrid) {
  const auto read = [](const char* text) { return volume_recipe_from_json(parse_json(text)); };
  const VolumeRecipe flat = read(R"({"solidnoise": 1, "layers": [{"fold": "ridged"}], "grid": "a",
                                     "shaping": {"type": "remap", "edge": 2}, "density": 4, "dim": 30})");
  const VolumeRecipe listed =
      read(R"({"solidnoise": 2, "grids": [{"name": "a", "layers": [{"fold": "ridged"}],
        "shaping": {"type": "remap", "edge": 2}, "scale": {"peak": 4}}], "domain": {"dim": 30}})");
  EXPECT_EQ(format_json(to_json(flat)), format_json(to_json(listed)));
  EXPECT_TRUE(listed.grids.empty());
  EXPECT_EQ(listed.grid, "a");
}

// As that version shipped them.
TEST(VolumeRecipeJson, ReadsRecipesOfVersion01AndWritesThemInTheNewForm) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(in_source("tests/volume/recipes_of_0.1"))) {
    std::ifstream stream(file.path());
    const Json old = Json::parse(stream);
    EXPECT_EQ(old.at("solidnoise"), 1) << file.path();
    const Json written = to_json(volume_recipe_from_json(old));
    EXPECT_EQ(written.at("solidnoise"), 2);
    EXPECT_EQ(written.at("grids").size(), 1u);
    EXPECT_EQ(written.at("description"), old.at("description"));
    EXPECT_EQ(format_json(to_json(volume_recipe_from_json(written))), format_json(written)) << file.path();
    ++count;
  }
  EXPECT_EQ(count, 6);
}

TEST(VolumeRecipeJson, RefusesGridsThatDoNotGoTogether) {
  const auto with = [](const std::string& rest) { return message_of(R"({"solidnoise": 2, )" + rest + "}"); };
  EXPECT_EQ(with(R"("grids": [{"name": "a"}, {"name": "a"}])"),
            "grids[1].name is a; there is a grid of that name before it");
  EXPECT_EQ(with(R"("grids": [{"drift": [0, 1, 0]}, {"name": "b"}])"),
            "grids[0].drift applies to output curl only");
  EXPECT_EQ(with(R"("grids": [{"layers": [{"place": "radius", "fold": "ridged"}]}])"),
            "grids[0].layers[0].fold has no effect on a place");
  EXPECT_EQ(with(R"("grids": [{"shaping": {"type": "remap", "edge": -1}}])"),
            "grids[0].shaping.edge is -1; it must be at least 0 (sigmas)");
}

// Whether there is one grid or several, and whether a reader or validate() refuses.
TEST(VolumeRecipeJson, MessagesGiveThePathInTheListOfGrids) {
  const auto with = [](const std::string& rest) { return message_of(R"({"solidnoise": 2, )" + rest + "}"); };
  for (const std::string before : {"", R"({"name": "first"}, )"}) {
    const auto grid = [&](const std::string& keys) {
      return with(R"("grids": [)" + before + R"({"name": "a", )" + keys + "}]");
    };
    const std::string path = before.empty() ? "grids[0]." : "grids[1].";
    EXPECT_EQ(grid(R"("output": "curl", "speed": -3)"),
              path + "speed is -3; it must be greater than 0 (world units per second)");
    EXPECT_EQ(grid(R"("output": "curly")").substr(0, 24), path + "output is curly");
    EXPECT_EQ(grid(R"("output": "value,gradient")"),
              path + "output is value,gradient; a grid that has a name, a, has one output");
    EXPECT_EQ(grid(R"("drift": [0, 1, 0])"), path + "drift applies to output curl only");
    EXPECT_EQ(grid(R"("scale": {"peak": -1})"),
              path + "scale.peak is -1; it must be greater than 0 (extinction per world unit)");
    EXPECT_EQ(
        grid(R"("layers": [{"layers": [{}, {"warp": {"amount": -3}}]}])"),
        path + "layers[0].layers[1].warp.amount is -3; it must be between 0 and 1000000000 (world units)");
    EXPECT_EQ(grid(R"("layers": [{"combine": "max"}])"),
              path + "layers[0].combine has no effect without layers");
    EXPECT_EQ(grid(R"("within": {"layers": [{"use": "a"}]})"),
              path + "within.layers[0].use is a; it must be left out where there are no fields");
    EXPECT_EQ(grid(R"("noise": {"type": "gabor", "filter": 1}, "layers": [{}])"),
              path + "noise.filter is 1; it must be 0 in a layer");
  }
}

TEST(VolumeRecipeJson, MessagesAboutTheWholeRecipeHaveNoPathOfAGrid) {
  const auto with = [](const std::string& rest) {
    return message_of(R"({"solidnoise": 2, "grids": [{"name": "a"}, {"name": "b"}], )" + rest + "}");
  };
  EXPECT_EQ(with(R"("dims": 5)"), "dims is 5; it must be between 3 and 4");
  EXPECT_EQ(with(R"("domain": {"dim": 0})"), "domain.dim is 0; it must be between 1 and 1048576 (voxels)");
  EXPECT_EQ(with(R"("domain": {"box": [0, 0, 0, 1, 0, 1]})"),
            "domain.box is 0 to 0 along y; its upper corner must lie beyond its lower one");
  EXPECT_EQ(with(R"("band_limit": true, "noise": {"type": "kensler"})").substr(0, 18), "band_limit is true");
}

TEST(VolumeRecipeJson, RefusesFieldsThatDoNotExistOrUseEachOtherInACircle) {
  const auto with = [](const std::string& fields, const std::string& use) {
    return message_of(R"({"solidnoise": 2, "time": 1, "fields": )" + fields +
                      R"(, "grids": [{"layers": [{"use": ")" + use + R"("}]}]})");
  };
  const std::string known = R"({"oak": {}, "birch": {}})";
  EXPECT_EQ(with(known, "okk"),
            "grids[0].layers[0].use is okk; it must be one of birch, oak; did you mean oak?");
  EXPECT_EQ(with(known, "limetree"), "grids[0].layers[0].use is limetree; it must be one of birch, oak");
  EXPECT_EQ(with(R"({"z": {"use": "x"}, "x": {"use": "y"}, "y": {"layers": [{}, {"use": "x"}]}})", "z"),
            "fields.y.layers[1].use is x; fields must not use each other in a circle: x, y, x");
}

TEST(VolumeRecipeJson, RefusesWhatIsNoRecipeOfThisVersion) {
  EXPECT_EQ(message_of("{}"), "\"solidnoise\": 2 is missing; this is no recipe");
  EXPECT_EQ(message_of(R"({"solidnoise": 3})"),
            "solidnoise is 3; this program reads recipes of versions 1 to 2");
  EXPECT_EQ(message_of(R"({"solidnoise": 2})"), "accepted");
  EXPECT_EQ(message_of(R"({"solidnoise": "1"})"), "solidnoise is \"1\"; it must be a whole number");
  EXPECT_EQ(message_of("[1]"), "the recipe is [1]; it must be an object");
  EXPECT_EQ(message_of(R"({"solidnoise": 1})"), "accepted");
}

TEST(VolumeRecipeJson, MessagesGiveThePathInTheTree) {
  const auto with = [](const std::string& rest) { return message_of(R"({"solidnoise": 1, )" + rest + "}"); };
  EXPECT_EQ(with(R"("noise": {"type": "gabor", "bandwidth": -1})"),
            "noise.bandwidth is -1; it must be between 0.05 and 4 (octaves)");
  EXPECT_EQ(with(R"("shaping": {"type": "remap", "softness": 0})"),
            "shaping.softness is 0; it must be greater than 0 (sigmas)");
  EXPECT_EQ(with(R"("shape": {"type": "cone"})"),
            "shape.type is \"cone\"; it must be one of box, sphere, ellipsoid, mesh, grid");
  EXPECT_EQ(with(R"("shape": {"type": "box", "file": "a"})"),
            "shape.file is unknown; the keys here are type");
  // Of more keys than a dozen the first.
  const std::string unknown = with(R"("zzzzzzzz": 1)");
  EXPECT_TRUE(unknown.starts_with("zzzzzzzz is unknown; the keys here are solidnoise, algorithm,"))
      << unknown;
  EXPECT_TRUE(unknown.ends_with(" more") && unknown.size() < 250) << unknown;
  EXPECT_EQ(with(R"("voxel": 0)"), "voxel is 0; it must be greater than 0 (world units)");
  EXPECT_EQ(with(R"("dims": 5)"), "dims is 5; it must be between 3 and 4");
  EXPECT_EQ(with(R"("time": 1)"),
            "time is 1; it must be 0 where dims is 3, there is no wind and the noise does not evolve");
  EXPECT_EQ(with(R"("box": [0, 0, 0, 1, 1])"), "box is [0,0,0,1,1]; it must be an array of 6 numbers");
  EXPECT_EQ(with(R"("grid": "")"), "grid is empty; it must be a name");
  EXPECT_EQ(with(R"("output": "curl", "speed": -1)"),
            "speed is -1; it must be greater than 0 (world units per second)");
  EXPECT_EQ(with(R"("output": "curl", "boundary": {"file": ""})"),
            "boundary.file is empty; it must be a .vdb");
  EXPECT_EQ(with(R"("output": "curl", "boundary": {"file": "a.vdb"}, "boundary_width": 0)"),
            "boundary_width is 0; it must be greater than 0 (world units)");
  EXPECT_EQ(with(R"("output": "curl", "boundary_width": 1)"), "boundary_width applies to a boundary only");
  EXPECT_EQ(with(R"("half": 1)"), "half is 1; it must be true or false");
  EXPECT_EQ(with(R"("voxel": 0.1, "dim": 3)"), "voxel and dim contradict each other; give one of them");
  EXPECT_EQ(with(R"("density": 1, "optical_depth": 3)"),
            "optical_depth and density contradict each other; give one of them");
  EXPECT_EQ(with(R"("density": -1)"), "density is -1; it must be greater than 0 (extinction per world unit)");
  EXPECT_EQ(with(R"("domain": {"dim": 0})"), "domain.dim is 0; it must be between 1 and 1048576 (voxels)");
}

TEST(VolumeRecipeJson, TellsTheAlgorithmsThatARecipeWasMadeWith) {
  EXPECT_EQ(algorithm_of(to_json(VolumeRecipe{})), kAlgorithmVersion);
  EXPECT_EQ(algorithm_of(parse_json(R"({"solidnoise": 1, "algorithm": 41})")), 41);
}

}  // namespace
}  // namespace solidnoise::volume_recipe_json_test
