#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/flag_set.h"
#include "solidnoise/mesh/bake_recipe.h"

namespace solidnoise {

// The recipe that the flags start from: that of --recipe, a .json file or a mesh made by meshnoise, or of a
// preset, rust unless they name one, or raw where they name a noise, which then is seen by itself.
BakeRecipe choose_bake_recipe(const FlagSet& flags);

// A recipe as comments of a mesh file, and back: empty if there is none among them.
std::vector<std::string> recipe_comments(const BakeRecipe& recipe);
std::optional<std::string> recipe_in_comments(const std::vector<std::string>& comments);

}  // namespace solidnoise
