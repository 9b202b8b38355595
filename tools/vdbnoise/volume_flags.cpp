#include "vdbnoise/volume_flags.h"

#include <filesystem>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/frames.h"
#include "common/noise_flags.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/stored_recipe.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {

std::string recipe_text_of(const std::filesystem::path& path) {
  return extension_of(path) == ".vdb" ? recipe_text_in(path) : read_text_file(path);
}

VolumeRecipe choose_volume_recipe(const FlagSet& flags, const std::string& standard) {
  VolumeRecipe recipe;
  load_recipe(flags, {standard, recipe_text_of},
              [&](const Json& json) { recipe = volume_recipe_from_json(json); });
  return recipe;
}

void turn_up(VolumeRecipe& recipe, UpAxis up) {
  if (recipe.up == up) return;
  const Vec<3> lower = recipe.box.lower;
  const Vec<3> upper = recipe.box.upper;
  if (up == UpAxis::z) {
    recipe.box = {{lower.x, -upper.z, lower.y}, {upper.x, -lower.z, upper.y}};
  } else {
    recipe.box = {{lower.x, lower.z, -upper.y}, {upper.x, upper.z, -lower.y}};
  }
  recipe.up = up;
}

void declare_output_flags(FlagSet& flags, VolumeRecipe& recipe) {
  GridRecipe& grid = recipe;
  declare_field(flags, grid, "output", [&recipe](const std::vector<Output>& output) {
    if (output == recipe.output) return;
    recipe.output = output;
    recipe.grid.clear();
    if (output.front() == Output::curl) return;
    recipe.speed = VolumeRecipe().speed;
    recipe.boundary.reset();
    recipe.boundary_width.reset();
  });
  declare_fields(flags, grid, {"speed", "boundary", "boundary_width"});
}

void declare_shaping_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.toggle("--raw", "The noise itself: mean 0, variance 1; no shaping",
               [&] { recipe.shaping = RawShaping{}; });
  declare_alternatives(flags, recipe.shaping,
                       {{shaping_types().begin(), shaping_types().end()},
                        "{} does not apply to the shaping {}; give --raw or another --preset too",
                        {"edge", "direction", "fold"}});  // flags of the shape, the noise and the layer
  static const CloudShaping kCloud{};
  declare_field(flags, kCloud, "edge", {"--cloud-edge", "cloud: "}, [&](double edge) {
    auto* const cloud = std::get_if<CloudShaping>(&recipe.shaping);
    if (!cloud) throw UsageError("--cloud-edge does not apply where there is no cloud");
    cloud->edge = edge;
  });
}

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
  Warp& warp = layer_of(recipe, "--warp").warp.emplace();
  warp.amount = numbers[0];
  if (numbers.size() < 2) return;
  warp.noise = recipe.noise;
  std::visit([&](auto& options) { options.frequency = numbers[1]; }, warp.noise->noise);
}

}  // namespace

void declare_layer_flags(FlagSet& flags, VolumeRecipe& recipe) {
  static const Layer kLayer{};
  declare_field(flags, kLayer, "fold", [&](Layer::Fold fold) {
    layer_of(recipe, "--fold").fold = fold;
    if (fold == Layer::Fold::none && is_own_noise(recipe.layers) && recipe.layers.front() == kLayer)
      recipe.layers.clear();
  });
  declare_field(flags, kLayer, "histogram",
                [&](Layer::Histogram histogram) { layer_of(recipe, "--histogram").histogram = histogram; });
  flags.numbers("--warp", "UNITS [FREQUENCY]",
                "Displace the noise by three others of this standard deviation [world units], and frequency; "
                "without it, its own",
                [&recipe](const std::vector<double>& numbers) {
                  require_in_range("--warp", numbers[0], 0.0, kFarthest, "world units");
                  if (numbers.size() > 1)
                    require("--warp", numbers[1], kFrequencies, "cycles per world unit");
                  set_warp(recipe, numbers);
                });
}

void check_layer_flags(const FlagSet& flags, const VolumeRecipe& recipe,
                       const std::vector<std::string>& noise_flags) {
  if (recipe.layers.empty()) return;
  if (!is_scalar(recipe)) {
    flags.refuse({"--warp", "--fold", "--histogram"},
                 fmt::format("makes a layer, which has its value only; --output is {}",
                             format_outputs(recipe.output)));
  }
  if (!use_own_noise(recipe.layers)) {
    constexpr const char* kWhy = "has no effect where each layer of the recipe has its own noise";
    for (const std::string& flag : noise_flags) {
      if (flag != "--seed") flags.refuse({flag}, kWhy);  // it is mixed with those of the layers
    }
    flags.refuse({"--evolve", "--loop"}, kWhy);
  }
  const bool uniform = is_own_noise(recipe.layers) && recipe.layers[0].ramp.empty() &&
                       recipe.layers[0].histogram == Layer::Histogram::uniform;
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (uniform && raw && raw->range != RawShaping::Range::raw) {
    throw UsageError(fmt::format("--range {} is of 3 sigma; --histogram uniform is from 0 to 1 as it is",
                                 name_of(kRangeChoices, raw->range)));
  }
}

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

void declare_time_flags(FlagSet& flags, VolumeRecipe& recipe) {
  static const Evolution kStill{};
  declare_field(flags, kStill, "evolve", {"--evolve", "Gabor noises: "},
                [&](double rate) { set_rate(recipe.noise, rate); });
  declare_fields(flags, recipe, {"time", "wind"});
  declare_field(flags, kStill, "loop", {"--loop", "With --evolve or --dims 4: "},
                [&](double loop) { set_loop(flags, recipe, loop); });
}

std::string explain(const FlagSet& flags, const std::string& message) {
  if (message.starts_with("a position has") || message.starts_with("position ")) {
    for (const char* flag : {"--offset", "--wind", "--warp", "--edge", "--box", "--origin", "--width"}) {
      if (flags.given(flag)) return fmt::format("{} goes too far: {}", flag, message);
    }
  }
  const auto noise = flags.value_of("--noise");
  if (noise && message.starts_with("the spectrum is "))
    return fmt::format("--noise is {}: {}", printable(*noise), message);
  return flags.name_flag(name_loop(flags, message));
}

}  // namespace solidnoise
