#include <cmath>
#include <memory>
#include <stdexcept>
#include <variant>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/volume/volume_field.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise::studio {
namespace {

void refuse_files(const VolumeRecipe& recipe) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument(
        what + " needs a file, which the page cannot read: run vdbnoise --recipe recipe.json --out out.vdb");
  };
  if (recipe.modification) refuse("on: a grid that exists");
  if (std::holds_alternative<MeshShape>(recipe.shape)) refuse("domain.shape: a mesh");
  if (std::holds_alternative<GridShape>(recipe.shape)) refuse("domain.shape: a grid");
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    if (grid.parameters.any()) refuse(std::string(grid.parameters.first_field()));
    if (grid.boundary) refuse("boundary");
  }
}

// Without its noise, which takes longer to make than a slider may wait for the recipe.
Json describe_grid(const VolumeRecipe& grid) {
  return {{"names", grid_names(grid)},
          {"raw", std::holds_alternative<RawShaping>(grid.shaping)},
          {"scalar", is_scalar(grid)},
          {"layers", !grid.layers.empty()}};
}

Json describe(const VolumeRecipe& recipe) {
  Json json{{"grids", Json::array()},
            {"changes", recipe.dims == 4 || evolves(recipe) || recipe.wind != Vec<3>(0.0)}};
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) json["grids"].push_back(describe_grid(grid));
  const Box<3>& box = recipe.box;
  json["box"] = {box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
  return json;
}

// Whether it is of meshnoise: by a key that vdbnoise does not have.
bool is_of_surface(const Json& json) {
  static const Json of_volume = volume_recipe_schema()["properties"];
  static const Json of_surface = bake_recipe_schema()["properties"];
  for (const auto& [key, value] : json.items()) {
    if (of_surface.contains(key) && !of_volume.contains(key)) return true;
  }
  return false;
}

VolumeRecipe volume_of(const Json& json) {
  VolumeRecipe recipe = volume_recipe_from_json(json);
  refuse_files(recipe);
  return recipe;
}

Answer described(const Json& json) {
  if (is_of_surface(json)) {
    const BakeRecipe recipe = bake_recipe_from_json(json);
    return {Json{{"kind", "surface"},
                 {"recipe", format_json(to_json(recipe))},
                 {"changes", recipe.changes_with_time()},
                 {"grids", Json::array()},
                 {"box", {-1, -1, -1, 1, 1, 1}}}};
  }
  const VolumeRecipe recipe = volume_of(json);
  Json description = describe(recipe);
  description["kind"] = "volume";
  description["recipe"] = format_json(to_json(recipe));
  return {description};
}

}  // namespace

VolumeRecipe read_recipe(const std::string& text) {
  try {
    return volume_of(parse_json(text));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(with_line(text, error.what()));
  }
}

VolumeRecipe grid_of_question(const Json& question) {
  const VolumeRecipe recipe = read_recipe(question.at("recipe"));
  const std::string grid = question.value("grid", "");
  return grid.empty() ? recipes_of_grids(recipe).front() : recipe_of_grid(recipe, grid);
}

Answer describe_fields(const Json&, std::span<const unsigned char>) {
  Answer answer{
      Json{{"volume", volume_recipe_schema()}, {"surface", bake_recipe_schema()}, {"ramps", ramp_names()}}};
  for (const std::string_view name : ramp_names()) {
    const ColorRamp ramp = parse_color_ramp(name);
    std::vector<float>& colors = answer.floats.emplace_back();
    for (int i = 0; i < 256; ++i) {
      const Color color = ramp.srgb(static_cast<float>(i) / 255.0f);
      for (int c = 0; c < 3; ++c) colors.push_back(color[c]);
    }
  }
  return answer;
}

Answer check_recipe(const Json& question, std::span<const unsigned char>) {
  const std::string text = question.at("recipe");
  try {
    return described(parse_json(text));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(with_line(text, error.what()));
  }
}

// "edits": {"path": ["noise", "frequency"], "value": 4}, in order; without a value the key is removed. With
// "keep", a list of keys, those that the object has stay, as where another type takes the place of one. The
// value is text, so that no number loses digits.
Answer edit_recipe(const Json& question, std::span<const unsigned char>) {
  Json recipe = parse_json(question.at("recipe").get<std::string>());
  for (const Json& edit : question.at("edits")) {
    Json* parent = &recipe;
    const Json& path = edit.at("path");
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Json& key = path[i];
      parent = key.is_number() ? &parent->at(key.get<std::size_t>()) : &(*parent)[key.get<std::string>()];
    }
    const Json& last = path.back();
    if (!edit.contains("value")) {
      if (last.is_number()) {
        parent->erase(last.get<std::size_t>());
      } else {
        parent->erase(last.get<std::string>());
      }
      continue;
    }
    Json value = parse_json(edit.at("value").get<std::string>());
    Json& place = last.is_number() ? (*parent)[last.get<std::size_t>()] : (*parent)[last.get<std::string>()];
    if (edit.contains("keep") && place.is_object()) {
      for (const Json& key : edit.at("keep")) {
        const std::string name = key;
        if (place.contains(name) && !value.contains(name)) value[name] = place[name];
      }
    }
    place = std::move(value);
  }
  try {
    return described(recipe);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(with_line(format_json(recipe), error.what()));
  }
}

}  // namespace solidnoise::studio
