#pragma once

#include <optional>
#include <string>

#include "common/flag_set.h"
#include "common/recipe_files.h"
#include "common/run_options.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/volume/sky/sky_plan.h"

namespace solidnoise {

// What the command line of `vdbnoise sky` says, beside the recipe.
struct SkyOptions : RunOptions {
  SkyRecipe recipe;
  std::string out;           // .usda: instances, .vdb: one grid; empty: none
  std::string write_points;  // .csv; empty: none
  std::string write_recipe;  // .json, "-" for the standard output; empty: none
  bool skip_existing = false;
  std::optional<Box<3>> region;  // of one grid
  RecipeInputs inputs;

  SkyForm form() const { return extension_of(out) == ".vdb" ? SkyForm::grid : SkyForm::instances; }
};

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`.
void declare_sky_flags(FlagSet& flags, SkyOptions& options);

// The recipe that the flags start from: that of --recipe, a .json file or a .vdb of a sky, or of a preset.
SkyRecipe choose_sky_recipe(const FlagSet& flags);

// Refuses what the flags leave without effect, and outputs that cannot be. Throws UsageError.
void check_sky_options(const FlagSet& flags, const SkyOptions& options);

}  // namespace solidnoise
