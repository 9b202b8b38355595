#pragma once

#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

// The JSON form of what a noise takes over from an exemplar:
//   {"raw_values": false, "mean": [r, g, b], "channels": [{"axis": [r, g, b], "dimensions": 2, "isotropic":
//   false,
//    "groups": ["all"], "bands": [{"a": 0.09, "components": [[x, y, variance, group], ...]}, ...]}, ...]}
// with x, y (and z of three dimensions) a component's frequency. Reading back what was written gives an equal
// model, to the last bit.
Json to_json(const ExemplarModel& model);

// Throws std::invalid_argument: wrong type, unknown key, value out of range, each with its path in the tree.
ExemplarModel exemplar_model_from_json(JsonReader& reader);

// As a field of other structs. Its schema says no more than that it is an object: noisefit writes it.
template <>
struct JsonForm<ExemplarModel> {
  static Json write(const ExemplarModel& model);
  static void read(JsonReader& reader, const std::string& key, ExemplarModel& model);
  static Json schema();
};

// The file of such a model: {"solidnoise": 1, "algorithm": 1, "exemplar": {...}}.
Json exemplar_file_to_json(const ExemplarModel& model);
ExemplarModel exemplar_file_from_json(const Json& json);

}  // namespace solidnoise
