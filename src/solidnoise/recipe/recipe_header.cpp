#include "solidnoise/recipe/recipe_header.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/noise/noise_recipe.h"

namespace solidnoise {

Json recipe_header() {
  Json json = Json::object();
  json["solidnoise"] = kRecipeVersion;
  json["algorithm"] = kAlgorithmVersion;
  return json;
}

void read_recipe_header(JsonReader& reader) {
  if (!reader.has("solidnoise")) {
    throw std::invalid_argument(
        fmt::format("\"solidnoise\": {} is missing; this is no recipe", kRecipeVersion));
  }
  int version = 0;
  reader.read("solidnoise", version);
  if (version < 1 || version > kRecipeVersion) {
    throw std::invalid_argument(fmt::format(
        "solidnoise is {}; this program reads recipes of versions 1 to {}", version, kRecipeVersion));
  }
  int algorithm = kAlgorithmVersion;
  reader.read("algorithm", algorithm);
  std::string schema;  // where editors find what keys there are
  reader.read("$schema", schema);
}

int algorithm_of(const Json& json) {
  JsonReader reader(json);
  int algorithm = kAlgorithmVersion;
  reader.read("algorithm", algorithm);
  return algorithm;
}

}  // namespace solidnoise
