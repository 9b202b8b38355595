#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/flag_set.h"
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

// Declares --output and what belongs to it: --speed, --boundary and --boundary-width. Another output takes
// back the grid's name and whatever else belonged to the one before.
void declare_output_flags(FlagSet& flags, VolumeRecipe& recipe);

// The preset to start from where --output asks for more than the noise's value: "velocity" or "raw", else
// nothing.
std::optional<std::string> preset_for_output(const FlagSet& flags);

// Declares the flags that fold, warp and map the recipe's noise: they make a layer of it. To be applied after
// those of the noise and its time.
void declare_layer_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses the flags that have no effect on the recipe's layers. Throws UsageError.
void check_layer_flags(const FlagSet& flags, const VolumeRecipe& recipe);

// Declares the flags of noise that changes with time: --dims, --time, --evolve, --loop. They act on `recipe`
// after those of the noise, which may change its type. `dims` are the dimensions that the command allows.
void declare_time_flags(FlagSet& flags, VolumeRecipe& recipe, const std::string& dims = "3|4");

// A message of the library about the period in time, by the name of the flag that it was given with.
std::string name_loop(const FlagSet& flags, const std::string& message);

}  // namespace solidnoise
