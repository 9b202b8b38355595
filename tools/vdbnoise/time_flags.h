#pragma once

#include <string>

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Declares the flags of noise that changes with time: --dims, --time, --evolve, --loop. They act on `recipe`
// after those of the noise, which may change its type. `dims` are the dimensions that the command allows.
void declare_time_flags(FlagSet& flags, VolumeRecipe& recipe, const std::string& dims = "3|4");

// A message of the library about the period in time, by the name of the flag that it was given with.
std::string name_loop(const FlagSet& flags, const std::string& message);

}  // namespace solidnoise
