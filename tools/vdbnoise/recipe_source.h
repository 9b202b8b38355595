#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// A recipe and what is to be said about it.
struct LoadedRecipe {
  VolumeRecipe recipe;
  std::string warning;  // empty: none
};

// The recipe of a .json file, or that of a .vdb made by vdbnoise: its first grid that carries one. Throws
// std::runtime_error naming the path, and the place in the recipe where there is one.
LoadedRecipe load_recipe(const std::filesystem::path& path);

// A recipe that comes with the program. Throws UsageError.
VolumeRecipe load_preset(const std::string& name);

}  // namespace solidnoise
