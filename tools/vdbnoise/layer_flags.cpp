#include "vdbnoise/layer_flags.h"

#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "common/noise_flags.h"
#include "common/usage_error.h"
#include "solidnoise/core/check.h"
#include "solidnoise/recipe/layer_json.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// The layer that the flags make: the recipe's noise and nothing else.
bool is_own_noise(const std::vector<Layer>& layers) {
  return layers.size() == 1 && layers[0].layers.empty() && !layers[0].noise;
}

Layer& layer_of(VolumeRecipe& recipe, const char* flag) {
  if (std::holds_alternative<CloudShaping>(recipe.shaping)) {
    throw UsageError(fmt::format("{} has no effect on a cloud; give --raw or another --preset too", flag));
  }
  if (recipe.layers.empty()) return recipe.layers.emplace_back();
  if (is_own_noise(recipe.layers)) return recipe.layers.front();
  throw UsageError(fmt::format("{} has no effect where the recipe has layers, each with its own", flag));
}

void set_warp(VolumeRecipe& recipe, const std::vector<double>& numbers) {
  require_at_least("warp", numbers[0], 0.0, "world units");
  Warp& warp = layer_of(recipe, "--warp").warp.emplace();
  warp.amount = numbers[0];
  if (numbers.size() < 2) return;
  require_positive("warp", numbers[1], "its frequency, cycles per world unit");
  warp.noise = recipe.noise;
  std::visit([&](auto& options) { options.frequency = numbers[1]; }, warp.noise->noise);
}

}  // namespace

void declare_layer_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.choice(
      "--fold", names_of(kLayerFoldChoices),
      "The noise's octaves |n| turned to ridges, or added up as turbulence; billow: |noise|; mean 0, "
      "variance 1 (default none)",
      [&recipe](std::size_t index) { layer_of(recipe, "--fold").fold = kLayerFoldChoices[index].value; });
  flags.choice("--histogram", names_of(kHistogramChoices),
               "Values as they are, or uniform on 0 to 1 by the error function (default gaussian)",
               [&recipe](std::size_t index) {
                 layer_of(recipe, "--histogram").histogram = kHistogramChoices[index].value;
               });
  flags.numbers("--warp", "UNITS [FREQUENCY]", 1,
                "Displace the noise by three others of this standard deviation, world units, and frequency "
                "(default its own)",
                [&recipe](const std::vector<double>& numbers) { set_warp(recipe, numbers); });
}

void check_layer_flags(const FlagSet& flags, const VolumeRecipe& recipe) {
  if (recipe.layers.empty()) return;
  if (!use_own_noise(recipe.layers)) {
    std::vector<std::string> without_effect = noise_flags();
    without_effect.insert(without_effect.end(), {"--evolve", "--loop"});
    for (const std::string& flag : without_effect) {
      if (flag == "--seed") continue;  // it is mixed with those of the layers
      if (!flags.given(flag)) continue;
      throw UsageError(
          fmt::format("{} has no effect where each layer of the recipe has its own noise", flag));
    }
  }
  const bool uniform = is_own_noise(recipe.layers) && recipe.layers[0].ramp.empty() &&
                       recipe.layers[0].histogram == Layer::Histogram::uniform;
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (uniform && raw && raw->range != RawShaping::Range::raw) {
    throw UsageError(fmt::format("--range {} is of 3 sigma; --histogram uniform is from 0 to 1 as it is",
                                 name_of(kRangeChoices, raw->range)));
  }
}

}  // namespace solidnoise
