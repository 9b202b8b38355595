#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/mesh/bake_recipe.h"

namespace solidnoise {

// A recipe and what is to be said about it.
struct LoadedBakeRecipe {
  BakeRecipe recipe;
  std::string warning;  // empty: none
};

// The recipe of a .json file, or that of a mesh made by meshnoise. Throws std::runtime_error naming the path,
// and the place in the recipe where there is one.
LoadedBakeRecipe load_bake_recipe(const std::filesystem::path& path);

// A recipe that comes with the program. Throws UsageError.
BakeRecipe load_bake_preset(const std::string& name);

// A recipe as comments of a mesh file, and back: empty if there is none among them.
std::vector<std::string> recipe_comments(const BakeRecipe& recipe);
std::optional<std::string> recipe_in_comments(const std::vector<std::string>& comments);

}  // namespace solidnoise
