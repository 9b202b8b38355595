#include "solidnoise/mesh/bake_recipe.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/mesh/bake_recipe_json.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::bake_recipe_test {
namespace {

BakeRecipe plain_recipe() {
  BakeRecipe recipe;
  return recipe;
}

BakeRecipe unusual_recipe() {
  BakeRecipe recipe;
  recipe.description = "A test";
  recipe.noise = {.kind = SurfaceNoiseKind::oriented,
                  .error = 0.05,
                  .impulses = 17.25,
                  .layer = 0.3,
                  .fractal = {.octaves = 3, .lacunarity = 2.5, .gain = 0.4, .renormalize = false},
                  .seed = 18446744073709551615u};
  recipe.frequency = ParameterRange{4.1, 32.0};
  recipe.bandwidth = {0.5, 1.5};
  recipe.magnitude = {0.1, 2.0};
  recipe.bias = {-1.0, 0.3};
  recipe.by = {.source = SteeringSource::attribute,
               .attribute = "heat",
               .low_percentile = 1.0,
               .high_percentile = 99.0,
               .gamma = 0.7};
  recipe.smooth = 5;
  recipe.smooth_radius = 0.25;
  recipe.direction = {
      .source = DirectionRecipe::Source::min_curvature, .axis = Vec<3>(1.0, 2.0, 3.0), .smooth = 7};
  recipe.ramp = "0:#000,1:#fff";
  recipe.contrast = 1.3;
  recipe.refine = {.mode = RefineRecipe::Mode::rounds, .rounds = 2, .method = RefineOptions::Method::sqrt3};
  recipe.displace = -0.01;
  recipe.up = UpAxis::z;
  return recipe;
}

BakeRecipe layered_recipe() {
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.layers = {{.turn = 30.0}, {.use = "thorns"}};
  recipe.fields = {{"thorns", {.fold = Layer::Fold::crest}}};
  recipe.properties = {{"height", {.use = "value", .weight = 0.5}},
                       {"wear", {.place = Layer::Place::weight}}};
  recipe.layer_unit = LayerUnit::feature;
  return recipe;
}

BakeRecipe recipe_by_example() {
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::spectrum;
  recipe.noise.exemplar = some_spectrum(2).model;
  recipe.ramp = kExemplarRamp;
  return recipe;
}

TEST(BakeRecipe, OnlyANoiseByExampleHasItsColors) {
  EXPECT_NO_THROW(recipe_by_example().validate());
  BakeRecipe recipe;
  recipe.ramp = kExemplarRamp;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "ramp is exemplar; only a noise by example has such colours");
  recipe = recipe_by_example();
  recipe.bandwidth = ParameterRange{1.0, 2.0};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "bandwidth is 1..2; this noise has one bandwidth for all vertices");
}

TEST(BakeRecipe, ComesBackFromJsonAsItWas) {
  for (const auto make : {&plain_recipe, &unusual_recipe, &layered_recipe, &recipe_by_example}) {
    const BakeRecipe recipe = make();
    EXPECT_EQ(bake_recipe_from_json(parse_json(format_json(to_json(recipe)))), recipe);
  }
}

TEST(BakeRecipe, WhatIsLeftOutHasItsDefault) {
  EXPECT_EQ(bake_recipe_from_json(parse_json(R"({"solidnoise": 1})")), plain_recipe());
  const BakeRecipe recipe = bake_recipe_from_json(parse_json(R"({"solidnoise": 1, "frequency": 3})"));
  EXPECT_EQ(recipe.frequency, (ParameterRange{3.0, 3.0}));
}

TEST(BakeRecipe, SaysWhereInTheTreeAnErrorIs) {
  const auto message = [](const char* text) {
    return message_of<std::invalid_argument>([&] { bake_recipe_from_json(parse_json(text)); });
  };
  EXPECT_EQ(message(R"({"solidnoise": 1, "surface": {"gian": 1}})").substr(0, 25),
            "surface.gian is unknown; ");
  EXPECT_EQ(message(R"({"solidnoise": 1, "by": {"source": "mood"}})"),
            "by.source is \"mood\"; it must be one of mean-curvature, gaussian-curvature, max-curvature, "
            "abs-curvature, height");
  EXPECT_EQ(message(R"({"solidnoise": 1, "by": {"source": "height", "attribute": "heat"}})"),
            "by.source and attribute contradict each other; give one of them");
  EXPECT_EQ(message(R"({"solidnoise": 1, "frequency": [1, 2, 3]})"),
            "frequency is [1,2,3]; it must be an array of 2 numbers");
  EXPECT_EQ(message(R"({"solidnoise": 1, "refine": {"mode": "rounds", "rounds": 99}})"),
            "refine.rounds is 99; it must be between 1 and 8 (rounds)");
  EXPECT_EQ(message(R"({"frequency": 1})"), "\"solidnoise\": 2 is missing; this is no recipe");
}

TEST(BakeRecipe, RefusesWhatIsOutOfRange) {
  const auto refused = [](const std::function<void(BakeRecipe&)>& change) {
    BakeRecipe recipe;
    change(recipe);
    return message_of<std::invalid_argument>([&] { recipe.validate(); });
  };
  EXPECT_EQ(refused([](BakeRecipe& r) {
              r.frequency = ParameterRange{4.0, -1.0};
            }).substr(0, 16),
            "frequency is -1;");
  EXPECT_EQ(refused([](BakeRecipe& r) {
              r.noise.kind = SurfaceNoiseKind::kensler;
              r.bandwidth = ParameterRange{1.0, 2.0};
            }),
            "bandwidth is 1..2; this noise has one bandwidth for all vertices");
  EXPECT_EQ(refused([](BakeRecipe& r) { r.direction.axis = Vec<3>(0.0); }),
            "direction is 0 0 0; it must point somewhere");
  EXPECT_NE(refused([](BakeRecipe& r) { r.ramp = "rusty"; }).find("rusty"), std::string::npos);
  EXPECT_EQ(refused([](BakeRecipe& r) { r.contrast = 0.0; }).substr(0, 13), "contrast is 0");
}

TEST(BakeRecipe, FrequenciesAreOfTheBoxOrOfTheFeaturesSize) {
  BakeRecipe recipe;
  recipe.detail = {0.5, 2.0};
  EXPECT_EQ(frequencies_of(recipe, 2.0), (ParameterRange{6.0, 24.0}));  // 24 features along the box
  recipe.feature_size = 0.1;
  EXPECT_EQ(frequencies_of(recipe, 2.0), (ParameterRange{5.0, 20.0}));
  recipe.frequency = ParameterRange{3.0, 4.0};
  recipe.detail = {};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "feature_size has no effect where there is a frequency; leave one of them out");
}

TEST(BakeRecipe, PropertiesHaveNamesOfTheirOwn) {
  BakeRecipe recipe;
  recipe.properties = {{"red", {}}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "properties has red; a name is letters, digits and underscores, and none of x, y, z, nx, ny, nz, "
            "red, green, blue, alpha, noise");
  recipe.properties = {{"rough ness", {}}};
  EXPECT_THROW(recipe.validate(), std::invalid_argument);
  recipe.properties = {{"height", {.use = "bumps"}}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "properties.height.use is bumps; it must be one of value");
  recipe.fields = {{"value", {}}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "fields has value; that is the name of what is baked");
}

TEST(BakeRecipe, SteersWhereALayerFollowsTheWeight) {
  BakeRecipe recipe;
  EXPECT_FALSE(recipe.steers());
  recipe.fields = {{"wear", {.place = Layer::Place::weight}}};
  EXPECT_FALSE(recipe.steers());
  recipe.properties = {{"roughness", {.use = "wear"}}};
  EXPECT_TRUE(recipe.steers());
}

// The middle of a range in octaves.
TEST(BakeRecipe, AFeatureIsACycleOfTheFrequency) {
  BakeRecipe recipe;
  EXPECT_EQ(feature_size_of(recipe, 48.0), 2.0);
  recipe.feature_size = 0.5;
  EXPECT_EQ(feature_size_of(recipe, 48.0), 0.5);
  recipe.feature_size.reset();
  recipe.frequency = ParameterRange{4.0, 16.0};
  EXPECT_EQ(feature_size_of(recipe, 48.0), 1.0 / 8.0);
}

}  // namespace
}  // namespace solidnoise::bake_recipe_test
