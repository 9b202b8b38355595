#include "vdbnoise/output_flags.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/usage_error.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {
namespace {

bool makes_velocity(const VolumeRecipe& recipe) {
  return recipe.output.front() == Output::curl;
}

void require_velocity(const VolumeRecipe& recipe, const char* flag) {
  if (!makes_velocity(recipe)) throw UsageError(fmt::format("{} applies to --output curl only", flag));
}

void change_output(VolumeRecipe& recipe, const std::vector<Output>& output) {
  if (output == recipe.output) return;
  recipe.output = output;
  recipe.grid.clear();
  if (makes_velocity(recipe)) return;
  recipe.speed = VolumeRecipe().speed;
  recipe.boundary.reset();
}

}  // namespace

void declare_output_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.text("--output", "WHAT",
             "value, gradient or both (value,gradient); curl: a velocity without divergence; color: three "
             "independent noises; phase,intensity: of gabor-oriented noise (default value)",
             [&](const std::string& text) { change_output(recipe, parse_outputs(text)); });
  flags.number("--speed", "SPEED", "With --output curl: root mean square, world units per second (default 1)",
               [&](double value) {
                 require_velocity(recipe, "--speed");
                 recipe.speed = value;
               });
  flags.text("--boundary", "FILE.vdb[:GRID]", "With --output curl: a level set that nothing flows through",
             [&](const std::string& text) {
               require_velocity(recipe, "--boundary");
               if (!recipe.boundary) recipe.boundary.emplace();
               recipe.boundary->surface = parse_grid_flag("--boundary", text);
             });
  flags.number("--boundary-width", "UNITS",
               "Distance from it over which the velocity turns along it (default 1 / frequency)",
               [&](double value) {
                 if (!recipe.boundary) throw UsageError("--boundary-width applies to --boundary only");
                 recipe.boundary->width = value;
               });
}

std::optional<std::string> preset_for_output(const FlagSet& flags) {
  const auto output = flags.value_of("--output");
  if (!output || *output == "value") return std::nullopt;
  return *output == "curl" ? "velocity" : "raw";
}

}  // namespace solidnoise
