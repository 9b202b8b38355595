#include "solidnoise/recipe/noise_recipe_json.h"

#include <algorithm>
#include <stdexcept>
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

Json JsonForm<Layer>::write(const Layer& layer) {
  Json json = Json::object();
  write_fields(layer, json);
  return json;
}

void JsonForm<Layer>::read(JsonReader& reader, const std::string& key, Layer& layer) {
  auto object = reader.object(key);
  if (!object) return;
  read_fields(*object, layer);
  object->finish();
}

Json JsonForm<Layer>::schema() {
  return {{"$ref", "#/$defs/layer"}};
}

Json JsonForm<NamedLayers>::write(const NamedLayers& layers) {
  Json json = Json::object();
  for (const auto& [name, layer] : layers) json[name] = json_of(layer);
  return json;
}

void JsonForm<NamedLayers>::read(JsonReader& reader, const std::string& key, NamedLayers& layers) {
  auto object = reader.object(key);
  if (!object) return;
  for (const std::string& name : object->keys()) read_value(*object, name, layers[name]);
  object->finish();
}

Json JsonForm<NamedLayers>::schema() {
  return {{"type", "object"}, {"additionalProperties", schema_of_value<Layer>()}};
}

}  // namespace solidnoise
