#include "solidnoise/volume/parameters/parameter_grids_json.h"

#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/volume/vdb/grid_file_json.h"

namespace solidnoise {
namespace {

void add(Json& recipe, const char* key, const std::optional<ParameterGrid>& grid) {
  if (!grid) return;
  Json& object = recipe[key];
  add_grid_file(object, grid->source);
  if (const auto& map = grid->map) object["map"] = {map->low, map->high, map->at_low, map->at_high};
}

void read(JsonReader& recipe, const std::string& key, std::optional<ParameterGrid>& grid) {
  auto object = recipe.object(key);
  if (!object) return;
  ParameterGrid& read = grid.emplace();
  read_grid_file(*object, read.source);
  if (object->has("map")) {
    Vec<4> map{0.0};
    object->read("map", map);
    read.map = ValueMap{map[0], map[1], map[2], map[3]};
  }
  object->finish();
}

}  // namespace

void add_parameter_grids(Json& recipe, const ParameterGrids& grids) {
  add(recipe, "frequency_grid", grids.frequency);
  add(recipe, "bandwidth_grid", grids.bandwidth);
  add(recipe, "magnitude_grid", grids.magnitude);
  if (grids.direction) add_grid_file(recipe["direction_grid"], *grids.direction);
}

void read_parameter_grids(JsonReader& recipe, ParameterGrids& grids) {
  read(recipe, "frequency_grid", grids.frequency);
  read(recipe, "bandwidth_grid", grids.bandwidth);
  read(recipe, "magnitude_grid", grids.magnitude);
  read_grid_file(recipe, "direction_grid", grids.direction);
}

}  // namespace solidnoise
