#include "solidnoise/recipe/noise_recipe_json.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace solidnoise::noise_recipe_json_test {
namespace {

NoiseRecipe from_text(const std::string& text) {
  const Json json = parse_json(text);
  JsonReader reader(json, "noise");
  return noise_recipe_from_json(reader);
}

NoiseRecipe round_trip(const NoiseRecipe& recipe) {
  return from_text(format_json(to_json(recipe)));
}

std::string message_of(const std::string& text) {
  try {
    from_text(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NoiseRecipeJson, RoundTripsEveryNoiseToTheLastBit) {
  const double awkward = 0.1 + 0.2;  // 0.30000000000000004: 17 digits
  NoiseRecipe gabor{GaborNoiseOptions{.frequency = 1.0 / 3.0,
                                      .bandwidth = awkward,
                                      .error = 0.0123456789012345678,
                                      .impulses = 1e3 / 7.0,
                                      .weights = ImpulseWeights::uniform,
                                      .seed = std::numeric_limits<std::uint64_t>::max(),
                                      .period = {awkward, 0.0, 64.0, 1e6 / 3.0},
                                      .evolution = {.rate = awkward, .loop = 1e3 / 3.0},
                                      .filter = 0.1 / 3.0},
                    FractalOptions{.octaves = 5, .lacunarity = 2.0, .gain = awkward, .renormalize = false}};
  NoiseRecipe oriented{OrientedGaborNoiseOptions{.frequency = 4.940656458412466e-12,
                                                 .anisotropy = 1.0 - 0x1p-53,
                                                 .direction = {awkward, -1.0, 1e-17, 0.25},
                                                 .seed = (1ULL << 53) + 1},
                       {}};
  NoiseRecipe kensler{GradientNoiseOptions{.frequency = 1.7976931348623157,
                                           .kernel = GradientNoiseOptions::Kernel::zero_dc,
                                           .support = GradientNoiseOptions::Support::half,
                                           .hash = GradientNoiseOptions::Hash::integer,
                                           .seed = 1},
                      {}};
  EXPECT_EQ(round_trip(gabor), gabor);
  EXPECT_EQ(round_trip(oriented), oriented);
  EXPECT_EQ(round_trip(kensler), kensler);
}

TEST(NoiseRecipeJson, NamesEachNoiseByItsType) {
  for (const char* type : {"gabor", "gabor-oriented", "kensler"}) {
    EXPECT_EQ(noise_type(default_noise(type)), type);
    EXPECT_EQ(to_json(default_noise(type))["type"], type);
  }
  EXPECT_THROW(default_noise("perlin"), std::invalid_argument);
}

TEST(NoiseRecipeJson, KeysLeftOutHaveTheirDefaults) {
  EXPECT_EQ(from_text(R"({"type": "gabor"})"), default_noise("gabor"));
}

TEST(NoiseRecipeJson, MessagesGiveThePathTheValueAndWhatIsAllowed) {
  EXPECT_EQ(message_of(R"({"type": "gabor", "bandwidth": -1})"),
            "noise.bandwidth is -1; it must be between 0.05 and 4 (octaves)");
  EXPECT_EQ(message_of(R"({"type": "gabor", "frequency": "8"})"),
            "noise.frequency is \"8\"; it must be a number");
  EXPECT_EQ(message_of(R"({"type": "perlin"})"),
            "noise.type is \"perlin\"; it must be one of gabor, gabor-oriented, kensler, spectrum, cellular");
  EXPECT_EQ(message_of(R"({"frequency": 8})"),
            "noise.type is missing; it must be one of gabor, gabor-oriented, kensler, spectrum, cellular");
  EXPECT_EQ(message_of(R"({"type": "gabor", "octaves": 2.5})"),
            "noise.octaves is 2.5; it must be a whole number");
  EXPECT_EQ(message_of(R"({"type": "gabor", "octaves": 99999999999})"),
            "noise.octaves is 99999999999; it must be a whole number");
  EXPECT_EQ(message_of(R"({"type": "gabor", "seed": -1})"),
            "noise.seed is -1; it must be a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(message_of(R"({"type": "gabor", "seed": -0})"), "accepted");
  EXPECT_EQ(message_of(R"({"type": "gabor", "period": [1, 2]})"),
            "noise.period is [1,2]; it must be an array of 4 numbers");
  EXPECT_EQ(message_of("[]"), "noise is []; it must be an object");
}

TEST(NoiseRecipeJson, RefusesUnknownKeysAndSaysWhichThereAre) {
  EXPECT_EQ(
      message_of(R"({"type": "kensler", "bandwidth": 1})"),
      "noise.bandwidth is unknown; the keys here are type, frequency, kernel, support, hash, seed, period, "
      "octaves, lacunarity, gain, renormalize");
}

TEST(NoiseRecipeJson, AsksWhetherAKnownKeyWasMeant) {
  EXPECT_EQ(message_of(R"({"type": "gabor", "bandwith": 1})"),
            "noise.bandwith is unknown; did you mean bandwidth?");
  EXPECT_EQ(message_of(R"({"type": "gabor", "lop": 1})"), "noise.lop is unknown; did you mean loop?");
  const std::string odd = message_of(R"({"type": "gabor", "a\n)" + std::string(500, 'x') + R"(": 1})");
  EXPECT_EQ(odd.find('\n'), std::string::npos);
  EXPECT_TRUE(odd.starts_with("noise.a\\nxxx"));
  EXPECT_LT(odd.size(), 300u);
}

}  // namespace
}  // namespace solidnoise::noise_recipe_json_test
