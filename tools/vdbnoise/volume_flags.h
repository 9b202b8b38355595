#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/flag_form.h"
#include "common/flag_set.h"
#include "common/run_tool.h"
#include "solidnoise/volume/volume_recipe.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {

// The text of the recipe that a .json, or a .vdb made by vdbnoise, has.
std::string recipe_text_of(const std::filesystem::path& path);

// The recipe that the flags start from: that of --recipe, a .json file or a .vdb made by vdbnoise (its first
// grid that carries one), or of a preset, `standard` unless they name one.
VolumeRecipe choose_volume_recipe(const FlagSet& flags, const std::string& standard);

// Another up axis turns the box about x, so that what stood upright still does.
void turn_up(VolumeRecipe& recipe, UpAxis up);

// Outputs as "value,gradient".
template <>
struct FlagForm<std::vector<Output>> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "WHAT"; }
  static std::vector<Output> read(const std::string&, const std::vector<std::string>& texts) {
    return parse_outputs(texts[0]);
  }
  static std::string write(const std::vector<Output>& outputs) { return format_outputs(outputs); }
};

// Declares --output and what belongs to it: --speed, --boundary and --boundary-width. Another output takes
// back the grid's name and whatever else belonged to the one before.
void declare_output_flags(FlagSet& flags, VolumeRecipe& recipe);

// Declares the flags of the recipe's shaping: --raw, and the fields of all shapings.
void declare_shaping_flags(FlagSet& flags, VolumeRecipe& recipe);

// Declares the flags that fold, warp and map the recipe's noise: they make a layer of it. To be applied after
// those of the noise and its time.
void declare_layer_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses the flags that have no effect on the recipe's layers, among them those of its noise. Throws
// UsageError.
void check_layer_flags(const FlagSet& flags, const VolumeRecipe& recipe,
                       const std::vector<std::string>& noise_flags);

// Declares the flags of noise that changes with time, but for --dims, which has to be declared before:
// --time, --evolve, --loop, --wind. They act on
// `recipe` after those of the noise, which may change its type.
void declare_time_flags(FlagSet& flags, VolumeRecipe& recipe);

// A message of the library by the name of the flag that it is about, as FlagSet::name_flag() has it; also one
// about a period in time, or about positions that are too far away.
std::string explain(const FlagSet& flags, const std::string& message);

// Runs what may throw std::invalid_argument about one of the flags' fields; it becomes a UsageError.
template <typename Run>
auto explained(const FlagSet& flags, const Run& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw UsageError(explain(flags, error.what()));
  }
}

}  // namespace solidnoise
