#pragma once

#include <optional>
#include <string>

#include "common/flag_set.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The value of a flag that names a grid, "FILE.vdb" or "FILE.vdb:GRID"; the file with its whole path, so that
// a recipe can be used from any folder. Throws UsageError.
GridFile parse_grid_flag(const std::string& flag, const std::string& text);

// Declares such a flag; what it names is kept in `target`.
void declare_grid_file(FlagSet& flags, const std::string& flag, const std::string& help,
                       std::optional<GridFile>& target);

// Declares --frequency-grid and its like. To be applied after the flags of the noise.
void declare_parameter_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses a constant beside a grid, which would be without effect. Throws UsageError.
void check_parameter_flags(const FlagSet& flags, const VolumeRecipe& recipe);

// Declares the flags for grids that exist, --on and those that go with it.
void declare_modify_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses those without --on, and the flags that have no effect with it. Throws UsageError.
void check_modify_flags(const FlagSet& flags, const VolumeRecipe& recipe);

}  // namespace solidnoise
