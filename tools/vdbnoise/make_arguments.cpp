#include "vdbnoise/make_arguments.h"

#include "vdbnoise/commands.h"
#include "vdbnoise/nvdb_output.h"
#include "vdbnoise/usd_output.h"

namespace solidnoise {
namespace {

// What the flags start from unless they say it.
std::string standard_preset(const FlagSet& flags) {
  const std::string output = flags.value_of("--output").value_or("value");
  if (output != "value") return output == "curl" ? "velocity" : "raw";
  return flags.given("--raw") || flags.given("--on") ? "raw" : "cumulus";
}

}  // namespace

MakeArguments::MakeArguments(const std::string& command, const std::string& description)
    : flags(command, description), noise_flags_(declare_make_flags(flags, options)) {
  flags.version(kVdbnoise);
}

VolumeRecipe MakeArguments::start() const {
  return choose_volume_recipe(flags, standard_preset(flags));
}

void MakeArguments::apply(const VolumeRecipe& start) {
  explained(flags, [&] {
    const std::vector<int> keys = flags.curve_frames();
    for (const int frame : keys) apply_at(start, frame);
    apply_at(start, 0);
    if (!keys.empty()) {
      if (options.frames.empty()) flags.refuse_curves("give --frames too");
      options.recipe_at = [this, start](int frame) {
        apply_at(start, frame);
        return options.recipe;
      };
    }
    check_sequence(flags, options);
    check_format(flags, options);
    check_usd(flags, options);
  });
}

void MakeArguments::apply_at(const VolumeRecipe& start, int frame) {
  options.recipe = start;
  options.inputs = recipe_inputs(flags);
  flags.apply(frame);
  check_make_options(flags, options, noise_flags_);
  options.recipe.validate();
}

}  // namespace solidnoise
