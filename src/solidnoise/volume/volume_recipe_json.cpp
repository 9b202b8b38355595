#include "solidnoise/volume/volume_recipe_json.h"

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {
namespace {

// In the order of the alternatives of Shape and Shaping.
constexpr std::array<std::string_view, 5> kShapeTypes{"box", "sphere", "ellipsoid", "mesh", "grid"};
constexpr std::array<std::string_view, 4> kShapingTypes{"raw", "remap", "veins", "cloud"};

// A recipe whose single grid has its keys in the recipe itself.
struct ShortForm : GridRecipe {
  std::optional<double> optical_depth;
  std::optional<double> peak;
  std::optional<double> factor;
};

constexpr auto fields_of(std::type_identity<ShortForm>) {
  return list_fields(fields_of_any_grid(),
                     field("optical_depth", &ShortForm::optical_depth, kPositive, "",
                           "Through the thickest column along the up axis"),
                     field("density", &ShortForm::peak, kPositive, "extinction per world unit",
                           "Instead: the largest density")
                         .in_place_of("optical_depth"),
                     field("density_factor", &ShortForm::factor, kPositive, "",
                           "What densities are multiplied by, where that is known"),
                     field("grid", &GridRecipe::grid, "Name of the grid"));
}

}  // namespace

template <>
struct JsonForm<Shape> : AlternativesForm<Shape, kShapeTypes> {};
template <>
struct JsonForm<Shaping> : AlternativesForm<Shaping, kShapingTypes> {};

// [low, high, at_low, at_high].
template <>
struct JsonForm<ValueMap> {
  static Json write(const ValueMap& map) { return {map.low, map.high, map.at_low, map.at_high}; }
  static void read(JsonReader& reader, const std::string& key, ValueMap& map) {
    std::array<double, 4> numbers{map.low, map.high, map.at_low, map.at_high};
    reader.read(key, numbers);
    map = {numbers[0], numbers[1], numbers[2], numbers[3]};
  }
  static Json schema() { return numbers_schema({}, 4); }
};

// [x0, y0, z0, x1, y1, z1].
template <>
struct JsonForm<Box<3>> {
  static Json write(const Box<3>& box) {
    return {box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
  }
  static void read(JsonReader& reader, const std::string& key, Box<3>& box) { reader.read(key, box); }
  static Json schema(const Interval& allowed) { return numbers_schema(allowed, 6); }
};

// "value,gradient".
template <>
struct JsonForm<std::vector<Output>> {
  static Json write(const std::vector<Output>& outputs) { return format_outputs(outputs); }
  static void read(JsonReader& reader, const std::string& key, std::vector<Output>& outputs) {
    std::string text = format_outputs(outputs);
    reader.read(key, text);
    reader.check([&] { outputs = parse_outputs(text); });
  }
  static Json schema() { return {{"type", "string"}}; }
};

namespace {

void require_name(const Json& json, const char* key, const std::string& path, const std::string& name) {
  if (json.contains(key) && name.empty()) {
    throw std::invalid_argument(path + key + " is empty; it must be a name");
  }
}

// A list of one grid of the recipe's noise becomes a short form, which flags can change.
void simplify(VolumeRecipe& recipe) {
  if (recipe.grids.size() != 1 || recipe.grids.front().own) return;
  static_cast<GridRecipe&>(recipe) = GridRecipe(recipe.grids.front());
  recipe.grids.clear();
}

void read_short_form(JsonReader& reader, VolumeRecipe& recipe) {
  ShortForm form;
  read_fields(reader, form);
  if (form.optical_depth) form.density.optical_depth = *form.optical_depth;
  form.density.peak = form.peak;
  form.density.factor = form.factor;
  static_cast<GridRecipe&>(recipe) = form;
}

void read_modification(JsonReader& reader, VolumeRecipe& recipe) {
  Modification modification;
  read_fields(reader, modification);
  for_each_field(modification, [&](const auto& field, const auto&) {
    if (reader.has(std::string(field.name))) recipe.modification = modification;
  });
  for (const char* key : {"domain", "shape", "box", "voxel", "dim", "grid"}) {
    if (!recipe.modification || !reader.has(key)) continue;
    throw std::invalid_argument(
        fmt::format("{} has no effect where a grid that exists is worked on, which has its own", key));
  }
}

// All of it as a list of grids with their names, but for those that others have.
VolumeRecipe in_long_form(VolumeRecipe recipe) {
  if (recipe.grids.empty()) recipe.grids.push_back(recipe);
  for (GridRecipe& grid : recipe.grids) {
    const bool has_name = !recipe.modification && grid.output.size() == 1;
    if (!has_name) grid.grid.clear();
    if (has_name && grid.grid.empty()) grid.grid = default_grid_name(grid.output.front());
  }
  return recipe;
}

}  // namespace

Json to_json(const VolumeRecipe& recipe) {
  Json json = recipe_header();
  write_fields(in_long_form(recipe), json);
  if (recipe.modification) {
    write_fields(*recipe.modification, json);
  } else {
    json["domain"] = json_of<Domain>(recipe);
  }
  return json;
}

VolumeRecipe volume_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  VolumeRecipe recipe;
  read_fields(reader, recipe);
  for (std::size_t i = 0; i < recipe.grids.size(); ++i) {
    require_name(json["grids"][i], "name", fmt::format("grids[{}].", i), recipe.grids[i].grid);
  }
  const bool is_listed = reader.has("grids");
  if (is_listed) {
    simplify(recipe);
  } else {
    read_short_form(reader, recipe);
    require_name(json, "grid", {}, recipe.grid);
  }
  read_modification(reader, recipe);
  Domain& domain = recipe;
  read_value(reader, "domain", domain);
  read_fields(reader, domain);
  reader.finish();
  recipe.validate(is_listed ? "grids[0]." : "");
  return recipe;
}

std::span<const std::string_view> shaping_types() {
  return kShapingTypes;
}

Json volume_recipe_schema() {
  Json schema = schema_of<VolumeRecipe>();
  Json& properties = schema["properties"];
  properties["domain"] = schema_of<Domain>();
  describe_schema(properties["domain"], "Where there are voxels; its keys may also be the recipe's own", {});
  for (const Json& others : {schema_of<ShortForm>(), schema_of<Modification>(), schema_of<Domain>()}) {
    properties.update(others["properties"]);
  }
  schema = file_schema("A volume of noise, for vdbnoise", std::move(schema));
  schema["$defs"] = {{"noise", noise_recipe_schema()}, {"layer", schema_of<Layer>()}};
  return schema;
}

}  // namespace solidnoise
