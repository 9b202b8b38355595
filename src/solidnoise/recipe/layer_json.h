#pragma once

#include <string>
#include <vector>

#include "solidnoise/field/field_tables.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

// The key "layers" of a recipe or a layer:
//   "layers": [
//     {"noise": {"type": "gabor", ...}, "fold": "ridged", "histogram": "gaussian", "weight": 0.5, "bias": 0,
//      "warp": {"amount": 0.2, "noise": {...}}},
//     {"combine": "max", "layers": [...], "ramp": [[-1, 0], [2, 1]]}
//   ]
// Every key may be left out. Without layers the key is not written.
void add_layers(Json& object, const std::vector<Layer>& layers);

// Throws std::invalid_argument with the path in the tree: wrong type, unknown key. What validate_layers()
// checks is left to it.
void read_layers(JsonReader& reader, std::vector<Layer>& layers);

// As a field, with a schema that refers to the definition "layer", for layers contain layers.
template <>
struct JsonForm<std::vector<Layer>> {
  static Json write(const std::vector<Layer>& layers);
  static void read(JsonReader& reader, const std::string& key, std::vector<Layer>& layers);
  static Json schema();
};

}  // namespace solidnoise
