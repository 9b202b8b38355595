#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/flag_form.h"
#include "common/frames.h"
#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/modified_volume.h"
#include "vdbnoise/make_options.h"

namespace solidnoise {
namespace {

// "3/8": the third of eight.
void parse_shard(const std::string& text, VolumePart& part) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    throw UsageError(fmt::format("--shard is {}; it must be which of how many, such as 3/8", text));
  }
  part.shard = parse_integer("--shard", text.substr(0, slash));
  part.shards = parse_integer("--shard", text.substr(slash + 1));
  if (part.shards < 1 || part.shard < 1 || part.shard > part.shards) {
    throw UsageError(fmt::format("--shard is {}; it must be K/N with K from 1 to N", text));
  }
}

// Calls `visit` with each file that a recipe reads for its parameters or for what it modifies, and the flag
// that names it.
template <typename Recipe, typename Visit>
void visit_inputs(Recipe& recipe, const Visit& visit) {
  auto& parameters = recipe.parameters;
  if (parameters.frequency) visit("--frequency-grid", parameters.frequency->source.file);
  if (parameters.bandwidth) visit("--bandwidth-grid", parameters.bandwidth->source.file);
  if (parameters.magnitude) visit("--magnitude-grid", parameters.magnitude->source.file);
  if (parameters.direction) visit("--direction-grid", parameters.direction->file);
  if (!recipe.modification) return;
  visit("--on", recipe.modification->on.file);
  if (recipe.modification->mask) visit("--mask", recipe.modification->mask->file);
  if (recipe.modification->rest) visit("--rest", recipe.modification->rest->file);
}

bool has_input_per_frame(const VolumeRecipe& recipe) {
  bool found = false;
  visit_inputs(recipe, [&](const char*, const std::string& file) { found |= has_frame_number(file); });
  return found;
}

bool has_wind(const VolumeRecipe& recipe) {
  return recipe.wind != Vec<3>(0.0);
}

bool changes_with_time(const VolumeRecipe& recipe) {
  return recipe.dims == 4 || evolves(recipe) || has_wind(recipe);
}

// Whether densities are scaled by something that is to be measured.
bool is_scaled(const VolumeRecipe& recipe) {
  return std::ranges::any_of(recipes_of_grids(recipe), measures_density);
}

double loop_of(const NoiseRecipe& noise, int dims) {
  if (dims == 4) return std::visit([](const auto& options) { return options.period[3]; }, noise.noise);
  return evolves(noise) ? evolution_of(noise)->loop : 0.0;
}

// Units of time; 0: the recipe does not loop, or not all of its noises in the same time.
double loop_of(const VolumeRecipe& recipe) {
  std::optional<double> loop;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const NoiseRecipe& noise : noises_of(single)) {
      if (recipe.dims == 3 && !evolves(noise)) continue;
      const double of_noise = loop_of(noise, recipe.dims);
      if (loop.value_or(of_noise) != of_noise) return 0.0;
      loop = of_noise;
    }
  }
  return loop.value_or(0.0);
}

// Where noise that loops is blown along it has to come to where it was.
void check_loop_of_wind(const VolumeRecipe& recipe) {
  constexpr double kRounding = 1e-9;
  const double loop = loop_of(recipe);
  if (loop == 0.0 || !has_wind(recipe)) return;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const NoiseRecipe& noise : noises_of(single)) {
      const Vec<4> period = period_of(noise);
      for (int axis = 0; axis < 3; ++axis) {
        const double way = recipe.wind[axis] * loop;
        const double rest = period[axis] > 0.0 ? std::remainder(way, period[axis]) : way;
        if (std::abs(rest) <= kRounding * std::abs(way)) continue;
        throw UsageError(fmt::format(
            "--wind is {} along {}, {:.6g} world units in the loop of {}; it must be a whole number of the "
            "noise's --period, or there must be no --loop",
            recipe.wind[axis], "xyz"[axis], way, loop));
      }
    }
  }
}

}  // namespace

void declare_sequence_flags(FlagSet& flags, MakeOptions& options) {
  flags.group("Sequences and parts");
  declare_frame_flags(flags, "cloud.####.vdb or cloud.%04d.vdb", options.frames, options.fps);
  flags.text("--shard", "K/N", "Make the K-th of N parts of the volume, for vdbnoise merge to join",
             [&](const std::string& text) { parse_shard(text, options.part); });
  flags.add({"--region", FlagForm<Box<3>>::names({}),
             "Make the 8^3 blocks of voxels that begin in this box, world units, for vdbnoise merge",
             [&](const std::vector<std::string>& texts) {
               options.part.region = FlagForm<Box<3>>::read("--region", texts);
             }});
}

void check_sequence(const FlagSet& flags, const MakeOptions& options) {
  if (options.frames.empty()) {
    flags.refuse({"--fps"}, "has no effect without --frames");
    refuse_frame_number("--out", options.out);
    refuse_frame_number("--preview", options.preview);
    visit_inputs(options.recipe,
                 [](const char* flag, const std::string& file) { refuse_frame_number(flag, file); });
  } else {
    const bool varies = options.recipe_at != nullptr;
    if (!varies && !changes_with_time(options.recipe) && !has_input_per_frame(options.recipe)) {
      throw UsageError(
          "--frames has no effect on a noise that does not change; give --evolve, --wind, --dims 4, a number "
          "as a curve (--density 0:1,24:3) or a file of each frame (--on smoke.####.vdb) too");
    }
    if ((varies || has_input_per_frame(options.recipe)) && !options.write_recipe.empty()) {
      throw UsageError(
          "--write-recipe is of one volume; leave it out where a flag is a curve, or a grid from a file for "
          "each frame");
    }
    if (options.out == "-") throw UsageError("--out is -; frames go to files, such as cloud.####.vdb");
    check_loop_of_wind(options.recipe);
    options_of_frame(options, 0);
  }
  if (!options.part.whole() && options.recipe.modification) {
    throw UsageError("--shard and --region cut volumes that are made; leave them out with --on");
  }
}

namespace {

// The factor of a sequence's densities is of what they are scaled to at its beginning; a frame's is in
// proportion.
void share_density_factor(VolumeRecipe of_sequence, VolumeRecipe& of_frame) {
  for (std::size_t i = 0; i < std::max<std::size_t>(1, of_frame.grids.size()); ++i) {
    const DensityScale& measured = grid_of(of_sequence, i).density;
    DensityScale& scale = grid_of(of_frame, i).density;
    if (!measured.factor || scale.factor) continue;
    scale.factor = *measured.factor * (scale.peak ? *scale.peak / measured.peak.value_or(1.0)
                                                  : scale.optical_depth / measured.optical_depth);
  }
}

}  // namespace

bool shares_density_factor(const MakeOptions& options) {
  const VolumeRecipe& recipe = options.recipe;
  return is_scaled(recipe) && !has_input_per_frame(recipe);
}

bool scales_each_frame(const MakeOptions& options) {
  return is_scaled(options.recipe) && has_input_per_frame(options.recipe);
}

MakeOptions options_of_frame(const MakeOptions& options, std::size_t index) {
  MakeOptions result = options;
  const int frame = options.frames[index];
  if (options.recipe_at) {
    result.recipe = options.recipe_at(frame);
    share_density_factor(options.recipe, result.recipe);
  }
  result.frames.clear();
  result.frame = frame;
  result.task_prefix = fmt::format("frame {} ({} of {}): ", frame, index + 1, options.frames.size());
  result.warns = index == 0;
  result.write_recipe.clear();
  if (!result.out.empty()) result.out = frame_path("--out", options.out, frame);
  if (!result.preview.empty()) result.preview = frame_path("--preview", options.preview, frame);
  visit_inputs(result.recipe, [frame](const char* flag, std::string& file) {
    if (has_frame_number(file)) file = frame_path(flag, file, frame);
  });
  if (!changes_with_time(result.recipe)) return result;
  result.recipe.time += frame_time(frame, options.fps, loop_of(options.recipe));
  return result;
}

}  // namespace solidnoise
