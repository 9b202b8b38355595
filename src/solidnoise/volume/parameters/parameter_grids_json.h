#pragma once

#include <string>

#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/volume/parameters/parameter_grids.h"

namespace solidnoise {

// Keys of a volume's recipe, each of which may be left out:
//   "frequency_grid": {"file": "smoke.vdb", "grid": "density", "digest": "0123456789abcdef",
//                      "map": [low, high, at_low, at_high]},
//   "bandwidth_grid" and "magnitude_grid": the same, "direction_grid": without a map.
void add_parameter_grids(Json& recipe, const ParameterGrids& grids);

// Throws std::invalid_argument with the path in the tree: wrong type, unknown key, no file.
void read_parameter_grids(JsonReader& recipe, ParameterGrids& grids);

// [low, high, at_low, at_high].
template <>
struct JsonForm<ValueMap> {
  static Json write(const ValueMap& map);
  static void read(JsonReader& reader, const std::string& key, ValueMap& map);
  static Json schema();
};

}  // namespace solidnoise
