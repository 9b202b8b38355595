#pragma once

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Declares the flags that fold, warp and map the recipe's noise: they make a layer of it. To be applied after
// those of the noise and its time.
void declare_layer_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses the flags that have no effect on the recipe's layers. Throws UsageError.
void check_layer_flags(const FlagSet& flags, const VolumeRecipe& recipe);

}  // namespace solidnoise
