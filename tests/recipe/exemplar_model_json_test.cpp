#include "solidnoise/recipe/exemplar_model_json.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/noise_recipe_json.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::exemplar_model_json_test {
namespace {

// Of three channels, with numbers of 17 digits.
ExemplarModel some_model() {
  ExemplarModel model = some_spectrum(3).model;
  model.channels[0].bands[0].a = 0.1 + 0.2;
  model.channels[0].bands[0].components[0].variance = 1.0 / 3.0;
  model.channels[0].groups = {"stochastic", "periodic"};
  model.channels[0].bands[1].components[0].group = 1;
  model.channels.resize(3, model.channels[0]);
  model.axes = {{1.0 / 7.0, 0.5, 0.25}, {-0.3, 0.1, 0.0}, {0.0, 0.0, 1e-3}};
  model.mean = {0.5, 1.0 / 3.0, 0.125};
  model.raw_values = true;
  model.squares = true;
  return model;
}

TEST(ExemplarModelJson, RoundTripsToTheLastBit) {
  const ExemplarModel model = some_model();
  const Json json = parse_json(format_json(exemplar_file_to_json(model)));
  EXPECT_EQ(exemplar_file_from_json(json), model);

  const NoiseRecipe recipe{SpectrumNoiseOptions{.model = model,
                                                .channel = 2,
                                                .frequency = 1.0 / 3.0,
                                                .error = 0.03,
                                                .impulses = 17.0,
                                                .seed = 5,
                                                .period = Vec<4>(100.0),
                                                .evolution = {.rate = 0.1 + 0.2, .loop = 3.0}},
                           {}};
  const Json noise = parse_json(format_json(to_json(recipe)));
  JsonReader reader(noise, "noise");
  EXPECT_EQ(noise_recipe_from_json(reader), recipe);
}

TEST(ExemplarModelJson, AChannelNeedsItsBandsOnly) {
  const ExemplarModel model = exemplar_file_from_json(parse_json(
      R"({"solidnoise": 1, "exemplar": {"channels": [{"bands": [{"a": 0.1, "components": [[0.2, 0, 3, 0]]}]}]}})"));
  EXPECT_EQ(model.channels[0].dimensions, 2);
  EXPECT_FALSE(model.channels[0].isotropic);
  EXPECT_EQ(model.channels[0].variance(), 3.0);
  EXPECT_EQ(model.axes[0], Vec<3>(1.0));
}

TEST(ExemplarModelJson, MessagesGiveThePathTheValueAndWhatIsAllowed) {
  const auto message = [](const std::string& channel) {
    const Json json = parse_json(R"({"solidnoise": 1, "exemplar": {"channels": [)" + channel + "]}}");
    return message_of<std::invalid_argument>([&] { exemplar_file_from_json(json); });
  };
  const std::string path = "exemplar.channels[0].";
  EXPECT_EQ(
      message(R"({"bands": [{"a": 0.1, "components": [[0.2, 0, 3, 0], [0, 1, 2]]}]})"),
      path +
          "bands[0].components is [[0.2,0,3,0],[0,1,2]]; it must be an array of [x, y, variance, group], "
          "which number 1 is not");
  EXPECT_EQ(message(R"({"bands": [{"a": 0.1, "components": [[0.2, 0, -3, 0]]}]})"),
            path + "bands[0].components[0].variance is -3; it must be 0 or more, and finite");
  EXPECT_EQ(message(R"({"bands": [{"a": 0.1, "components": [[0.2, 0, 3, 1]]}]})"),
            path + "bands[0].components[0].group is 1; it must be the number of a group, from 0");
  EXPECT_EQ(message(R"({"bands": [{"a": -1, "components": [[0.2, 0, 3, 0]]}]})"),
            path + "bands[0].a is -1; it must be between 1e-16 and 1e+16 (cycles per world unit)");
  EXPECT_EQ(message(R"({"dimensions": 4, "bands": []})"), path + "dimensions is 4; it must be 2 or 3");
  EXPECT_EQ(message(R"({"bands": [], "colour": 1})"),
            path + "bands is []; it must be an array of objects, of one at least");
  EXPECT_EQ(message(R"({"groups": [1]})"), path + "groups is [1]; it must be an array of texts");
  const auto refused = [](const std::string& text) {
    return message_of<std::invalid_argument>([&] { exemplar_file_from_json(parse_json(text)); });
  };
  EXPECT_EQ(refused(R"({"exemplar": {}})").substr(0, 12), "\"solidnoise\"");
  EXPECT_EQ(refused(R"({"solidnoise": 3, "exemplar": {}})").substr(0, 15), "solidnoise is 3");
  EXPECT_EQ(refused(R"({"solidnoise": 1})"), "exemplar is missing; it must be the model of an exemplar");
  EXPECT_EQ(refused(R"({"solidnoise": 1, "exemplar": {"channels": []}})"),
            "exemplar.channels is []; it must be an array of objects, of one at least");
}

}  // namespace
}  // namespace solidnoise::exemplar_model_json_test
