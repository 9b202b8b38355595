#pragma once

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Declares the flags for grids that exist, --on and those that go with it.
void declare_modify_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses those without --on, and the flags that have no effect with it. Throws UsageError.
void check_modify_flags(const FlagSet& flags, const VolumeRecipe& recipe);

}  // namespace solidnoise
