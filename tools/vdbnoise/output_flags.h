#pragma once

#include <optional>
#include <string>

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Declares --output and what belongs to it: --speed, --boundary and --boundary-width. Another output takes
// back the grid's name and whatever else belonged to the one before.
void declare_output_flags(FlagSet& flags, VolumeRecipe& recipe);

// The preset to start from where --output asks for more than the noise's value: "velocity" or "raw", else
// nothing.
std::optional<std::string> preset_for_output(const FlagSet& flags);

}  // namespace solidnoise
