#pragma once

#include <string>
#include <string_view>

#include "solidnoise/field/field_tables.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

// The JSON form of a noise, a flat object:
//   {"type": "gabor", "frequency": 8, "bandwidth": 1, ..., "seed": 7, "octaves": 3, "lacunarity": 2, "gain":
//   0.5}
// "type" is the name of its entry (noise_entries.h): gabor, gabor-oriented, kensler or spectrum, a noise by
// example, whose model is the object "exemplar", see exemplar_model_json.h. The other keys are those of the
// tables of its options and of FractalOptions, and each may be left out. The time of an evolution is not part
// of the form: it is for whoever makes frames to say when a noise is looked at. Reading back what was written
// gives an equal recipe, to the last bit.
Json to_json(const NoiseRecipe& recipe);

// Throws std::invalid_argument: wrong type, unknown key, value out of range, each with its path in the tree.
NoiseRecipe noise_recipe_from_json(JsonReader& reader);

// The JSON Schema of a noise.
Json noise_recipe_schema();

// As a field of other structs, with a schema that refers to the definition "noise".
template <>
struct JsonForm<NoiseRecipe> {
  static Json write(const NoiseRecipe& recipe) { return to_json(recipe); }
  static void read(JsonReader& reader, const std::string& key, NoiseRecipe& recipe);
  static Json schema();
};

// The "type" of a noise, and a noise of default options for a type. The latter throws std::invalid_argument.
std::string_view noise_type(const NoiseRecipe& recipe);
NoiseRecipe default_noise(std::string_view type);

// A layer as a field:
//   {"noise": {"type": "gabor", ...}, "fold": "ridged", "histogram": "gaussian", "weight": 0.5, "bias": 0,
//    "warp": {"amount": 0.2, "noise": {...}}}
// or {"combine": "max", "layers": [...], "ramp": [[-1, 0], [2, 1]]}, with a schema that refers to the
// definition "layer", for layers contain layers. What validate_layers() checks is left to it.
template <>
struct JsonForm<Layer> {
  static Json write(const Layer& layer);
  static void read(JsonReader& reader, const std::string& key, Layer& layer);
  static Json schema();
};

// Layers by name: {"paint": {"noise": ...}, ...}.
template <>
struct JsonForm<NamedLayers> {
  static Json write(const NamedLayers& layers);
  static void read(JsonReader& reader, const std::string& key, NamedLayers& layers);
  static Json schema();
};

}  // namespace solidnoise
