#include "solidnoise/recipe/noise_recipe_json.h"

#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/recipe/exemplar_model_json.h"

namespace solidnoise {

std::string_view noise_type(const NoiseRecipe& recipe) {
  return noise_names()[recipe.noise.index()];
}

NoiseRecipe default_noise(std::string_view type) {
  const std::vector<std::string_view> names = noise_names();
  const auto found = std::find(names.begin(), names.end(), type);
  if (found == names.end()) {
    throw std::invalid_argument(
        fmt::format("noise is {}; it must be one of {}", type, fmt::join(names, ", ")));
  }
  NoiseRecipe recipe;
  make_alternative(recipe.noise, static_cast<std::size_t>(found - names.begin()));
  return recipe;
}

Json to_json(const NoiseRecipe& recipe) {
  Json json = Json::object();
  write_alternative(recipe.noise, noise_names(), json);
  write_fields(recipe.fractal, json);
  return json;
}

NoiseRecipe noise_recipe_from_json(JsonReader& reader) {
  NoiseRecipe recipe;
  read_alternative(reader, noise_names(), recipe.noise);
  read_fields(reader, recipe.fractal);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

void JsonForm<NoiseRecipe>::read(JsonReader& reader, const std::string& key, NoiseRecipe& recipe) {
  if (auto object = reader.object(key)) recipe = noise_recipe_from_json(*object);
}

Json JsonForm<NoiseRecipe>::schema() {
  return {{"$ref", "#/$defs/noise"}};
}

Json noise_recipe_schema() {
  return alternatives_schema(std::type_identity<NoiseVariant>(), noise_names(),
                             schema_of<FractalOptions>()["properties"]);
}

Json JsonForm<std::vector<Layer>>::write(const std::vector<Layer>& layers) {
  Json json = Json::array();
  for (const Layer& layer : layers) json.push_back(json_of(layer));
  return json;
}

void JsonForm<std::vector<Layer>>::read(JsonReader& reader, const std::string& key,
                                        std::vector<Layer>& layers) {
  for (JsonReader& object : reader.objects(key)) {
    read_fields(object, layers.emplace_back());
    object.finish();
  }
}

Json JsonForm<std::vector<Layer>>::schema() {
  return {{"type", "array"}, {"items", {{"$ref", "#/$defs/layer"}}}, {"minItems", 1}};
}

void add_layers(Json& object, const std::vector<Layer>& layers) {
  if (!layers.empty()) object["layers"] = json_of(layers);
}

void read_layers(JsonReader& reader, std::vector<Layer>& layers) {
  read_value(reader, "layers", layers);
}

}  // namespace solidnoise
