#pragma once

#include <string>
#include <vector>

#include "common/flag_set.h"
#include "solidnoise/volume/volume_recipe.h"
#include "vdbnoise/make_options.h"
#include "vdbnoise/volume_flags.h"

namespace solidnoise {

// A command line that says what volumes to make. First flags.parse(), then apply() to the recipe that the
// flags override, such as start(). Lives as long as its options are used.
class MakeArguments {
 public:
  MakeArguments(const std::string& command, const std::string& description);

  // The recipe of --recipe or --preset, or the preset that suits the other flags.
  VolumeRecipe start() const;
  // Puts what the flags say into `options`, and refuses what has no effect or does not fit together. Throws
  // UsageError.
  void apply(const VolumeRecipe& start);

  FlagSet flags;
  MakeOptions options;

 private:
  void apply_at(const VolumeRecipe& start, int frame);

  std::vector<std::string> noise_flags_;
};

}  // namespace solidnoise
