#pragma once

#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/recipe_files.h"
#include "common/run_options.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/slice/slice_view.h"

namespace solidnoise {

// What the command line of `vdbnoise slice` says.
struct SliceOptions : SliceRecipe, SliceView, RunOptions {
  std::string out;       // .png, .exr, or .csv for a line; empty: none
  std::string spectrum;  // .png or .exr; empty: none
  SampleType sample_type = SampleType::automatic;
  RecipeInputs inputs;

  bool is_line() const { return extension_of(out) == ".csv"; }
};

// Declares all flags, and returns those of the noise. Before they are applied the caller puts the recipe that
// they override into `options`.
std::vector<std::string> declare_slice_flags(FlagSet& flags, SliceOptions& options);

// Finishes and checks what the flags say together. Throws UsageError and std::invalid_argument.
void check_slice_options(const FlagSet& flags, SliceOptions& options,
                         const std::vector<std::string>& noise_flags);

}  // namespace solidnoise
