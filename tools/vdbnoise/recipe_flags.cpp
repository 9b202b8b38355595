#include "vdbnoise/recipe_flags.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {
namespace {

std::string stored_recipe(const std::filesystem::path& path) {
  for (const GridSummary& summary : read_vdb_summary(path).grids) {
    const auto found = summary.metadata.find(kRecipeKey);
    if (found != summary.metadata.end()) return found->second;
  }
  throw std::runtime_error(fmt::format("{}: none of its grids carries a recipe of vdbnoise", path.string()));
}

}  // namespace

LoadedRecipe load_recipe(const std::filesystem::path& path) {
  const std::string text = path.extension() == ".vdb" ? stored_recipe(path) : read_text_file(path);
  LoadedRecipe loaded;
  loaded.warning =
      read_recipe(path, text, [&](const Json& json) { loaded.recipe = volume_recipe_from_json(json); });
  return loaded;
}

VolumeRecipe load_preset(const std::string& name) {
  return volume_recipe_from_json(parse_json(find_preset(name).json));
}

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
  recipe.boundary_width.reset();
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
               recipe.boundary = parse_grid_flag("--boundary", text);
             });
  flags.number("--boundary-width", "UNITS",
               "Distance from it over which the velocity turns along it (default 1 / frequency)",
               [&](double value) {
                 if (!recipe.boundary) throw UsageError("--boundary-width applies to --boundary only");
                 recipe.boundary_width = value;
               });
}

std::optional<std::string> preset_for_output(const FlagSet& flags) {
  const auto output = flags.value_of("--output");
  if (!output || *output == "value") return std::nullopt;
  return *output == "curl" ? "velocity" : "raw";
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
