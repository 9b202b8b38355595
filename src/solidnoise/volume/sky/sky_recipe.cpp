#include "solidnoise/volume/sky/sky_recipe.h"

#include <stdexcept>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/named_error.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/sky/sky_tables.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {

template <>
struct JsonForm<SkyPoints> : AlternativesForm<SkyPoints, kSkyPointsTypes> {};

// The keys of a volume's recipe, without what a file begins with.
template <>
struct JsonForm<VolumeRecipe> {
  static Json write(const VolumeRecipe& recipe) {
    const Json header = recipe_header();
    Json json = to_json(recipe);
    for (const auto& [key, value] : header.items()) json.erase(key);
    return json;
  }
  // Only that there is an object: cloud_from_json() reads it.
  static void read(JsonReader& reader, const std::string& key, VolumeRecipe&) { reader.object(key); }
  static Json schema() {
    Json schema = volume_recipe_schema();
    for (const char* key : {"$schema", "title", "$defs", "required"}) schema.erase(key);
    for (const char* key : {"solidnoise", "algorithm", "$schema"}) schema["properties"].erase(key);
    return schema;
  }
};

namespace {

// Of a whole recipe, or of its keys alone.
VolumeRecipe cloud_from_json(const Json& json) {
  Json whole = recipe_header();
  whole.update(json);
  return in_field("cloud.", [&] { return volume_recipe_from_json(whole); });
}

void require_shape(const VolumeRecipe& cloud) {
  if (cloud.modification || std::holds_alternative<GridShape>(cloud.shape) ||
      std::holds_alternative<MeshShape>(cloud.shape)) {
    throw std::invalid_argument(
        "cloud.shape is of a file; it must be box, sphere or ellipsoid, as large as a "
        "point says");
  }
  if (cloud.parameters.any()) {
    throw std::invalid_argument(fmt::format(
        "cloud.{} is a grid, which stands at one place; it must be left out where a recipe is placed "
        "at many",
        cloud.parameters.first_field()));
  }
}

}  // namespace

void SkyRecipe::validate() const {
  require_fields(*this);
  in_field("cloud.", [&] { cloud.validate(); });
  require_shape(cloud);
  if (const auto* const scattered = std::get_if<ScatteredPoints>(&points)) {
    in_field("points.", [&] { scattered->validate(); });
  } else if (std::get<PointsFile>(points).file.empty()) {
    throw std::invalid_argument("points.file is empty; it must name a .csv or .ply");
  }
}

Json to_json(const SkyRecipe& recipe) {
  Json json = recipe_header();
  write_fields(recipe, json);
  return json;
}

SkyRecipe sky_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  SkyRecipe recipe;
  read_fields(reader, recipe);
  if (reader.has("cloud")) recipe.cloud = cloud_from_json(json["cloud"]);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

Json sky_recipe_schema() {
  Json schema = file_schema("A sky of clouds, for vdbnoise sky", schema_of<SkyRecipe>());
  schema["$defs"] = volume_recipe_schema()["$defs"];
  return schema;
}

}  // namespace solidnoise
