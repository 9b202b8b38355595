#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "support/message_of.h"

namespace solidnoise::layer_json_test {
namespace {

std::string refusal_of(const std::string& layers) {
  const std::string text = R"({"solidnoise": 1, "layers": )" + layers + "}";
  return message_of<std::invalid_argument>([&] { volume_recipe_from_json(parse_json(text)); });
}

Layer every_field() {
  Layer leaf{.noise = NoiseRecipe{GradientNoiseOptions{.frequency = 0.3, .seed = ~0ULL}, {}},
             .fold = Layer::Fold::billow,
             .histogram = Layer::Histogram::uniform,
             .ramp = {{0.0, 1.0 / 3.0}, {0.5, -1.0}},
             .weight = -0.7,
             .bias = 1e-9};
  leaf.warp = Warp{.amount = 0.2, .noise = NoiseRecipe{OrientedGaborNoiseOptions{}, {}}};
  Layer mix{.layers = {leaf, Layer{}, leaf}, .combine = Layer::Combine::mix};
  mix.warp = Warp{.amount = 0.1};
  return mix;
}

TEST(LayerJson, TreesComeBackAsTheyWere) {
  VolumeRecipe recipe;
  recipe.layers = {every_field(), Layer{.fold = Layer::Fold::turbulence}};
  const std::string text = format_json(to_json(recipe));
  const VolumeRecipe back = volume_recipe_from_json(parse_json(text));
  EXPECT_EQ(back.layers, recipe.layers);
  EXPECT_EQ(format_json(to_json(back)), text);
}

TEST(LayerJson, RecipesWithoutLayersDoNotNameThem) {
  EXPECT_FALSE(to_json(VolumeRecipe{}).at("grids").at(0).contains("layers"));
}

TEST(LayerJson, MessagesGiveThePathInTheTree) {
  EXPECT_EQ(refusal_of(R"([{}, {"noise": {"type": "gabor", "bandwidth": -1}}])"),
            "layers[1].noise.bandwidth is -1; it must be between 0.05 and 4 (octaves)");
  EXPECT_EQ(
      refusal_of(R"([{"layers": [{}, {"fold": "wavy"}]}])"),
      "layers[0].layers[1].fold is \"wavy\"; it must be one of none, ridged, billow, turbulence, crest");
  EXPECT_EQ(refusal_of(R"([{"warp": {"noise": {"type": "kensler", "frequency": 0}}}])"),
            "layers[0].warp.noise.frequency is 0; it must be between 1e-12 and 1000000000000 (cycles per "
            "world unit)");
  EXPECT_EQ(refusal_of(R"([{"warp": {"amount": -2}}])"),
            "layers[0].warp.amount is -2; it must be between 0 and 1000000000 (world units)");
  EXPECT_EQ(refusal_of(R"([{"warp": {"size": 1}}])"),
            "layers[0].warp.size is unknown; the keys here are amount, noise");
  EXPECT_EQ(refusal_of(R"([{"weight": "much"}])"), "layers[0].weight is \"much\"; it must be a number");
  EXPECT_EQ(refusal_of(R"([{"histogram": "flat"}])"),
            "layers[0].histogram is \"flat\"; it must be one of gaussian, uniform");
  EXPECT_EQ(refusal_of(R"([{"combine": "xor"}])"),
            "layers[0].combine is \"xor\"; it must be one of sum, product, max, min, mix");
  EXPECT_EQ(refusal_of(R"([{"ramp": [[0, 1], 2]}])"),
            "layers[0].ramp is [[0,1],2]; it must be an array of pairs of numbers, which number 1 is not");
  EXPECT_EQ(refusal_of(R"([{"ramp": [[0, 1]]}])"), "layers[0].ramp has 1 stop; it must have at least 2");
  EXPECT_EQ(refusal_of(R"([{"ramp": [[0, 1], [0, 2]]}])"),
            "layers[0].ramp[1] is at 0; it must be beyond the stop before it, 0");
  EXPECT_EQ(refusal_of(R"({})"), "layers is {}; it must be an array of objects, of one at least");
  EXPECT_EQ(refusal_of(R"([])"), "layers is []; it must be an array of objects, of one at least");
  EXPECT_EQ(refusal_of(R"([3])"), "layers[0] is 3; it must be an object");
}

TEST(LayerJson, RefusesWhatHasNoEffect) {
  EXPECT_EQ(refusal_of(R"([{"combine": "max"}])"), "layers[0].combine has no effect without layers");
  EXPECT_EQ(refusal_of(R"([{"fold": "billow", "layers": [{}]}])"),
            "layers[0].fold has no effect on a layer that combines others");
  EXPECT_EQ(refusal_of(R"([{"noise": {"type": "gabor"}, "layers": [{}]}])"),
            "layers[0].noise has no effect on a layer that combines others");
  EXPECT_EQ(refusal_of(R"([{"histogram": "uniform", "layers": [{}]}])"),
            "layers[0].histogram has no effect on a layer that combines others");
  EXPECT_EQ(refusal_of(R"([{"combine": "mix", "layers": [{}, {}]}])"),
            "layers[0].layers has 2; mix takes 3: from, to and mask");
  EXPECT_EQ(
      refusal_of(R"([{"noise": {"type": "gabor", "octaves": 3}, "fold": "ridged", "histogram": "uniform"}])"),
      "layers[0].histogram is uniform; it must be gaussian where 3 octaves are folded one by one, whose "
      "distribution has no closed form");
  EXPECT_EQ(refusal_of(R"([{"noise": {"type": "gabor", "octaves": 3, "renormalize": false}}])"),
            "layers[0].noise.renormalize is false; it must be true in a layer, which has a weight");
  EXPECT_EQ(refusal_of(R"([{"noise": {"type": "gabor", "filter": 0.1}}])"),
            "layers[0].noise.filter is 0.1; it must be 0 in a layer");
  EXPECT_EQ(refusal_of(R"([{}], "shaping": {"type": "cloud"})"),
            "layers have no effect on a cloud, whose shaping takes the noise's octaves");
  EXPECT_EQ(
      refusal_of(R"([{}], "band_limit": true)"),
      "band_limit is true; it must be false where dims is 4, for gradient noise (kensler), with layers and "
      "where frequency, bandwidth or direction are from a grid");
}

TEST(LayerJson, LimitsDepthAndNumber) {
  std::string deep = "{}";
  for (int level = 1; level < kDeepestLayer; ++level) deep = R"({"layers": [)" + deep + "]}";
  EXPECT_EQ(refusal_of("[" + deep + "]"), "nothing was thrown");
  EXPECT_NE(refusal_of(R"([{"layers": [)" + deep + "]}]").find("is at level 9; layers can be 8 deep"),
            std::string::npos);
  std::string many = "{}";
  for (int i = 1; i < kMostLayers; ++i) many += ", {}";
  EXPECT_EQ(refusal_of("[" + many + "]"), "nothing was thrown");
  EXPECT_EQ(refusal_of("[" + many + ", {}]"), "layers[64] is one too many; there can be 64 layers");
}

// A layer may move where the recipe's own noise stands still.
TEST(LayerJson, LayersMayEvolve) {
  const std::string moving = R"([{"noise": {"type": "gabor", "evolve": 0.5}}], "time": 2)";
  EXPECT_EQ(refusal_of(moving), "nothing was thrown");
  EXPECT_EQ(refusal_of(moving + R"(, "dims": 4)"), "dims is 4; it must be 3 where the noise evolves");
}

}  // namespace
}  // namespace solidnoise::layer_json_test
