#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"

namespace solidnoise {

// The JSON in a file of the project's folder.
Json read_json(const std::string& path);

// The recipes of a folder of the project by their names, in alphabetical order.
std::map<std::string, Json> recipes_in(const std::string& folder);

// Whether a recipe of the examples is of a mesh.
inline bool is_of_mesh(const Json& recipe) {
  return recipe.contains("surface");
}

}  // namespace solidnoise
