#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The recipe that a grid carries, if it does. Throws std::runtime_error that begins with `file`, where the
// grid is from, for one that cannot be read.
std::optional<VolumeRecipe> stored_recipe(const openvdb::GridBase& grid, const std::string& file);

// The text of the recipe that a .vdb carries. Throws std::runtime_error naming the path, also where there is
// none.
std::string recipe_text_in(const std::filesystem::path& path);

}  // namespace solidnoise
