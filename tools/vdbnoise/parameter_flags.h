#pragma once

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Declares --frequency-grid and its like. To be applied after the flags of the noise.
void declare_parameter_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses a constant beside a grid, which would be without effect. Throws UsageError.
void check_parameter_flags(const FlagSet& flags, const VolumeRecipe& recipe);

}  // namespace solidnoise
