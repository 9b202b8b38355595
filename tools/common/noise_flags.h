#pragma once

#include <string>
#include <vector>

#include "common/flag_set.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// Declares the flags of a noise, those of the tables of all noises, which act on `recipe` when they are
// applied. A flag that the noise has no use for is refused then. Returns their names.
std::vector<std::string> declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe);

// Declares --generator. Declare it after all other flags of the noise and of its dimensions.
void declare_generator_flag(FlagSet& flags, NoiseRecipe& recipe, const int& dims);

// Makes it another kind of noise ("gabor-oriented"), with what the old one and it have in common.
void change_noise_type(NoiseRecipe& recipe, const std::string& type);

// What to say, in a line, of a loop in the middle of which a noise is much like its own negative, for its
// impulses turn about once; empty where it is not.
std::string loop_warning(const Evolution& evolution);

}  // namespace solidnoise
