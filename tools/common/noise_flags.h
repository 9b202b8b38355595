#pragma once

#include "common/flag_set.h"
#include "solidnoise/noise/noise_recipe.h"

namespace solidnoise {

// Declares the flags of a noise, which act on `recipe` when they are applied. A flag that the noise has no
// use for is refused then.
void declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe);

}  // namespace solidnoise
