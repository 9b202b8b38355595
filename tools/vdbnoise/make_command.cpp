#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/describe_volume.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/stream_volume.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/grid_flags.h"
#include "vdbnoise/make_options.h"
#include "vdbnoise/nvdb_output.h"
#include "vdbnoise/usd_output.h"
#include "vdbnoise/volume_flags.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

constexpr char kMakeDescription[] =
    "vdbnoise makes volumes of procedural noise, as OpenVDB files.\n"
    "  vdbnoise --preset smoke --seed 7 --dim 384 --out smoke.vdb --preview smoke.png   makes smoke\n"
    "  vdbnoise merge FILE... --out whole.vdb   joins parts made by --shard or --region\n"
    "  vdbnoise surface MESH --out surface.vdb  makes the level set of a mesh\n"
    "  vdbnoise slice --out noise.png           makes a picture of a plane, or a line of samples\n"
    "  vdbnoise info FILE                       prints a file's grids and recipe\n"
    "  vdbnoise analyze FILE                    measures a grid and compares it with the theory";

// What the flags start from unless they say it.
std::string standard_preset(const FlagSet& flags) {
  const std::string output = flags.value_of("--output").value_or("value");
  if (output != "value") return output == "curl" ? "velocity" : "raw";
  return flags.given("--raw") || flags.given("--on") ? "raw" : "cumulus";
}

void check_outputs(const MakeOptions& options) {
  if (options.out.empty() && options.preview.empty() && options.write_recipe.empty()) {
    throw UsageError("--out is missing; say where the grid goes: --out cloud.vdb");
  }
  check_output_names(is_nvdb(options) ? std::string() : options.out, options.preview);
  const auto unless_kept = [&](const std::string& path) {
    return options.skip_existing && std::filesystem::exists(path) ? std::string() : path;
  };
  if (options.skip_existing && options.out.empty()) {
    throw UsageError("--skip-existing keeps volumes; it needs --out FILE.vdb");
  }
  const bool has_scene = options.usd && !options.frame;
  const std::string scene = has_scene ? usd_scene_path(options.out) : std::string();
  require_outputs({unless_kept(options.out), unless_kept(options.preview), options.write_recipe, scene},
                  options.existing());
}

Target target_of(const MakeOptions& options) {
  if (!options.preview.empty()) return Target::picture;
  return options.out == "-" || is_nvdb(options) ? Target::pipe : Target::file;
}

// Before work: what it would take against what there is, or is allowed. Says how the volume is to be made.
Making check_cost(const MakeOptions& options, const VolumeRecipe& recipe, const VolumePlan& plan) {
  const int threads = max_threads();
  auto [making, cost] =
      plan_making(recipe, plan, threads, static_cast<double>(options.memory_limit()), target_of(options));
  if (is_nvdb(options)) cost.bytes += nvdb_bytes(recipe, plan);
  const openvdb::Coord voxels = plan.voxels.dim();
  options.require_cost(fmt::format("{} x {} x {} voxels", voxels.x(), voxels.y(), voxels.z()),
                       {cost.bytes, cost.seconds / threads},
                       plan.modification ? "" : "; make --dim smaller or --voxel larger");
  return making;
}

void write_recipe(const MakeOptions& options, const VolumePlan& plan, OutputGroup* group) {
  if (options.write_recipe.empty()) return;
  write_text_file(options.write_recipe, format_json(to_json(with_digests(options.recipe, plan))),
                  {.existing = options.existing(), .group = group});
}

Image picture(const Volume& volume, const VolumePlan& plan, const MakeOptions& options, Progress* progress) {
  return options.part.whole()
             ? picture_of(volume, options.recipe, options.preview_frame, progress)
             : picture_of_part(volume, options.recipe, plan, options.preview_frame, progress);
}

// Whether nothing is left to be done, for the files are there already. Throws if the volume's is another one.
bool is_made(const MakeOptions& options, const VolumePlan& plan) {
  if (!options.skip_existing || !std::filesystem::exists(options.out)) return false;
  if (!holds_volume(options.out, options.recipe, plan)) {
    throw std::runtime_error(options.out +
                             ": exists already, and is damaged or of another recipe; --force replaces it");
  }
  if (!options.preview.empty() && !std::filesystem::exists(options.preview)) return false;
  if (!options.quiet) std::cerr << options.out << ": is kept\n";
  return true;
}

VdbWriteOptions write_options(const MakeOptions& options, Progress* progress, OutputGroup* group) {
  VdbWriteOptions write;
  write.codec = options.recipe.codec;
  write.existing = options.skip_existing ? Existing::replace : options.existing();
  write.creator = kVdbnoise;
  write.frame = options.frame;
  if (options.frame) write.fps = options.fps;
  write.progress = progress;
  write.group = group;
  return write;
}

// Of one volume; a sequence's is written at its end.
void write_scene_of(const MakeOptions& options, const Volume& volume, OutputGroup* group) {
  if (!options.usd || options.frame) return;
  UsdScene scene;
  add_to_scene(scene, options, volume);
  write_scene(scene, options, group);
}

// Makes a volume, and its files; until these are begun, an interruption ends the process.
Volume make_in_memory(const MakeOptions& options, const VolumePlan& plan,
                      std::unique_ptr<EndsAtOnce> ends_at_once) {
  TaskProgress progress(options.visibility());
  options.times->begin("noise");
  progress.begin(options.task_prefix + "noise", [&] { options.times->begin("tree"); });
  Volume volume = make_volume(options.recipe, plan, kVdbnoise, &progress);
  std::optional<Image> preview;
  if (!options.preview.empty()) {
    options.times->begin("preview");
    progress.begin(options.task_prefix + "preview");
    preview = picture(volume, plan, options, &progress);
  }
  options.times->begin("writing");
  progress.begin(options.task_prefix + "writing");
  ends_at_once.reset();
  throw_if_cancelled(&progress);
  OutputGroup outputs;
  if (preview) write_image(options.preview, *preview, {.existing = options.existing(), .group = &outputs});
  write_recipe(options, plan, &outputs);
  std::vector<double> errors;
  if (is_nvdb(options)) {
    errors = write_nvdb(options.out, volume, {options.nvdb_values, options.existing(), &progress, &outputs});
  } else if (!options.out.empty()) {
    write_volume(options.out, volume, write_options(options, &progress, &outputs));
  }
  write_scene_of(options, volume, &outputs);
  outputs.appear();
  if (is_nvdb(options) && !options.quiet) print_nvdb_errors(options, volume, errors);
  return volume;
}

// The same of a volume that does not fit into memory.
Volume stream_to_files(const MakeOptions& options, const VolumePlan& plan,
                       std::unique_ptr<EndsAtOnce> ends_at_once) {
  TaskProgress progress(options.visibility());
  options.times->begin("streaming");
  progress.begin(options.task_prefix + "streaming");
  ends_at_once.reset();
  OutputGroup outputs;
  write_recipe(options, plan, &outputs);
  Volume volume =
      stream_volume(options.out, options.recipe, plan, write_options(options, &progress, &outputs));
  write_scene_of(options, volume, &outputs);
  outputs.appear();
  return volume;
}

// Makes one volume; adds it to the scene of a sequence, if there is one.
void make_volume_files(const MakeOptions& options, UsdScene* scene = nullptr) {
  auto ends_at_once = std::make_unique<EndsAtOnce>();
  options.times->begin("plan");
  const VolumePlan plan = plan_volume(options.recipe, options.part);
  if (options.out.empty() && options.preview.empty()) return write_recipe(options, plan, nullptr);
  if (is_made(options, plan)) return write_recipe(options, plan, nullptr);
  const Making making = check_cost(options, options.recipe, plan);
  const auto warn = [&] {
    if (!options.quiet && options.warns) warn_of_resolution(options.recipe, plan, std::cerr);
  };
  // What is refused is not warned of as well; parameters are checked voxel by voxel.
  const bool is_checked = !plan.parameters;
  if (is_checked) warn();

  const Volume volume = making == Making::streamed ? stream_to_files(options, plan, std::move(ends_at_once))
                                                   : make_in_memory(options, plan, std::move(ends_at_once));
  options.times->begin("end");
  if (scene) add_to_scene(*scene, options, volume);
  if (!is_checked) warn();
  const bool empty = std::ranges::all_of(
      volume.grids, [](const MeasuredGrid& measured) { return measured.moments.front().count() == 0; });
  if (empty && options.part.whole() && !options.quiet) {
    std::cerr << "vdbnoise: warning: the volume is empty: no voxel of it has a density; another --seed, a "
                 "higher --frequency or another shape may have some\n";
  }
  if (!options.quiet) print_statistics(volume, options.out.empty() ? options.preview : options.out);
}

// The one factor by which all frames of a sequence are scaled, of entry i of the recipe's grids.
double measure_sequence(const MakeOptions& options, const VolumeRecipe& recipe) {
  const EndsAtOnce ends_at_once;
  options.times->begin("scale");
  const VolumePlan plan = plan_volume(recipe, options.part);
  check_cost(options, recipe, plan);
  std::optional<double> factor;
  {
    TaskProgress progress(options.visibility());
    progress.begin("density scale");
    factor = measure_density_factor(recipe, plan, &progress);
  }
  if (!factor) {
    throw std::runtime_error(
        fmt::format("the volume is empty at time {}, at which the densities of a sequence are measured; give "
                    "--density-factor",
                    options.recipe.time));
  }
  if (!options.quiet) {
    std::cerr << fmt::format("density factor {:.6g}, of time {:.6g} and all frames\n", *factor,
                             options.recipe.time);
  }
  return *factor;
}

// Makes the frames one after the other. One that fails leaves the others; an interruption ends all.
void make_sequence(MakeOptions options) {
  const bool makes_volumes = !options.out.empty() || !options.preview.empty();
  for (std::size_t i = 0; makes_volumes && i < options.frames.size(); ++i) {
    check_outputs(options_of_frame(options, i));
  }
  if (options.usd) require_outputs({usd_scene_path(options.out)}, options.existing());
  MakeOptions recipe_only = options;
  recipe_only.out.clear();
  recipe_only.usd = false;
  recipe_only.preview.clear();
  if (!options.write_recipe.empty()) check_outputs(recipe_only);
  if (scales_each_frame(options) && !options.quiet) {
    std::cerr << "vdbnoise: warning: each frame has a grid of its own and is scaled by itself, which may "
                 "flicker; --density-factor gives all one scale\n";
  }
  if (shares_density_factor(options)) {
    const std::vector<VolumeRecipe> singles = recipes_of_grids(options.recipe);
    for (std::size_t i = 0; i < singles.size(); ++i) {
      if (!measures_density(singles[i])) continue;
      grid_of(options.recipe, i).density.factor = measure_sequence(options, singles[i]);
    }
  }
  if (!options.write_recipe.empty()) {
    recipe_only.recipe = options.recipe;
    make_volume_files(recipe_only);
    if (!makes_volumes) return;
  }
  std::size_t failed = 0;
  UsdScene scene;
  for (std::size_t i = 0; i < options.frames.size(); ++i) {
    try {
      if (i > failed) {
        set_what_is_left(
            fmt::format("nothing is written of frame {}; frames before it are", options.frames[i]));
      }
      make_volume_files(options_of_frame(options, i), options.usd ? &scene : nullptr);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::runtime_error& error) {
      ++failed;
      std::cerr << fmt::format("vdbnoise: frame {}: {}\n", options.frames[i], error.what());
    }
  }
  if (failed == 0 && options.usd) write_scene(scene, options, nullptr);
  if (failed == 0) return;
  throw std::runtime_error(fmt::format("{} of {} frames failed", failed, options.frames.size()));
}

// Reads the grid that frames previews, if one is named.
void read_preview_frame(MakeOptions& options) {
  constexpr const char* kFlag = "--preview-frame";
  if (!options.frame_source) return;
  if (options.preview.empty() || recipes_of_grids(options.recipe).front().output.front() != Output::value) {
    throw UsageError(fmt::format("{} has no effect without a --preview of values", kFlag));
  }
  const EndsAtOnce ends_at_once;
  options.preview_frame = read_float_grid(*options.frame_source, kFlag);
}

int make(MakeOptions options) {
  catch_interrupts();
  read_preview_frame(options);
  const auto threads = options.limit_threads();
  if (options.frames.empty()) {
    check_outputs(options);
    make_volume_files(options);
  } else {
    make_sequence(options);
  }
  if (options.timings) std::cerr << options.times->report();
  return kDone;
}

}  // namespace

int run_make(const std::vector<std::string>& arguments) {
  MakeOptions options;
  FlagSet flags("vdbnoise", kMakeDescription);
  const std::vector<std::string> noise_flags = declare_make_flags(flags, options);
  flags.version(kVdbnoise);
  flags.parse(arguments);
  try {
    const VolumeRecipe start = choose_volume_recipe(flags, standard_preset(flags));
    const auto apply_at = [&](int frame) {
      options.recipe = start;
      flags.apply(frame);
      check_make_options(flags, options, noise_flags);
      options.recipe.validate();
    };
    const std::vector<int> keys = flags.curve_frames();
    for (const int frame : keys) apply_at(frame);
    apply_at(0);
    if (!keys.empty()) {
      if (options.frames.empty()) flags.refuse_curves("give --frames too");
      options.recipe_at = [&, apply_at](int frame) {
        apply_at(frame);
        return options.recipe;
      };
    }
    check_sequence(flags, options);
    check_format(flags, options);
    check_usd(flags, options);
    if (!flags.given("--describe")) return make(options);
    std::cout << format_json(describe_volume(
        options.recipe, {options.part, static_cast<double>(options.memory_limit()), target_of(options)}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(explain(flags, error.what()));
  }
  return kDone;
}

}  // namespace solidnoise
