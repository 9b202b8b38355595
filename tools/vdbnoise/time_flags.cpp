#include "vdbnoise/time_flags.h"

#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "common/usage_error.h"
#include "solidnoise/core/check.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {
namespace {

void set_rate(NoiseRecipe& noise, double rate) {
  Evolution* const evolution = evolution_of(noise);
  if (!evolution) {
    throw UsageError(fmt::format(
        "--evolve does not apply to --noise {}, which has no impulses; --dims 4 does", noise_type(noise)));
  }
  evolution->rate = rate;
}

void set_loop(const FlagSet& flags, VolumeRecipe& recipe, double loop) {
  require_at_least("loop", loop, 0.0, "units of time; 0 for none");
  if (recipe.dims == 4) {
    double& period =
        std::visit([](auto& options) -> double& { return options.period[3]; }, recipe.noise.noise);
    if (flags.given("--period") && period != 0.0) {
      throw UsageError("--loop and the fourth number of --period are the same; give one of them");
    }
    period = loop;
    return;
  }
  if (!evolves(recipe.noise)) {
    throw UsageError("--loop has no effect on a noise that does not change; give --evolve or --dims 4 too");
  }
  evolution_of(recipe.noise)->loop = loop;
}

}  // namespace

void declare_time_flags(FlagSet& flags, VolumeRecipe& recipe, const std::string& dims) {
  flags.group("Time");
  flags.number(
      "--evolve", "RATE",
      "Gabor noises: impulses turn at rates of this standard deviation, turns per unit of time; each "
      "frame has the noise's spectrum",
      [&](double value) { set_rate(recipe.noise, value); });
  flags.integer("--dims", dims, "Dimensions of the noise; 4: a frame is a slice of a noise of 4 (default 3)",
                [&](int value) { recipe.dims = value; });
  flags.number("--time", "TIME", "With --evolve or --dims 4: the moment to make (default 0)",
               [&](double value) { recipe.time = value; });
  flags.number("--loop", "TIME", "With --evolve or --dims 4: repeat exactly after this time; 0 for never",
               [&](double value) { set_loop(flags, recipe, value); });
}

std::string name_loop(const FlagSet& flags, const std::string& message) {
  constexpr std::string_view kPeriod = "period is ";
  constexpr std::string_view kAxis = " along t;";
  const std::size_t axis = message.find(kAxis);
  if (!flags.given("--loop") || !message.starts_with(kPeriod) || axis == std::string::npos) return message;
  const std::string value = message.substr(kPeriod.size(), axis - kPeriod.size());
  return fmt::format("--loop is {};{}", value, message.substr(axis + kAxis.size()));
}

}  // namespace solidnoise
