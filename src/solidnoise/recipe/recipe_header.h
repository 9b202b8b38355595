#pragma once

#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

// What every whole recipe begins with: {"solidnoise": 1, "algorithm": 1, ...}. "algorithm" is
// kAlgorithmVersion when the recipe was written. "$schema" may name the recipe's JSON Schema, for editors.
Json recipe_header();

// Reads these keys. Throws std::invalid_argument where "solidnoise" is missing or another version.
void read_recipe_header(JsonReader& reader);

// The algorithm version that a recipe was written with; kAlgorithmVersion if it does not say.
int algorithm_of(const Json& json);

}  // namespace solidnoise
