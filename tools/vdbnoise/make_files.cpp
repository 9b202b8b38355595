#include "vdbnoise/make_files.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/stream_volume.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/grid_flags.h"
#include "vdbnoise/nvdb_output.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {

Target target_of(const MakeOptions& options) {
  if (!options.preview.empty()) return Target::picture;
  return options.out == "-" || is_nvdb(options) ? Target::pipe : Target::file;
}

namespace {

// The files that a recipe reads.
void add_files(const Json& json, std::vector<std::string>& files) {
  for (const auto& item : json.items()) {
    if (item.key() == "file" && item.value().is_string()) files.push_back(item.value());
    if (item.value().is_structured()) add_files(item.value(), files);
  }
}

}  // namespace

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
  std::vector<std::string> inputs{options.inputs.recipe, options.inputs.noise};
  add_files(to_json(options.recipe), inputs);
  std::vector<std::string> replaceable{options.inputs.recipe};
  if (options.recipe.modification) replaceable.push_back(options.recipe.modification->on.file);
  require_outputs({{unless_kept(options.out), replaceable},
                   unless_kept(options.preview),
                   {options.write_recipe, {options.inputs.recipe}},
                   scene},
                  options.existing(), inputs);
}

namespace {

// Before work: what it would take against what there is, or is allowed. Says how the volume is to be made.
Making check_cost(const MakeOptions& options, const VolumeRecipe& recipe, const VolumePlan& plan) {
  const int threads = max_threads();
  auto [making, cost] =
      plan_making(recipe, plan, threads, static_cast<double>(options.memory_limit()), target_of(options));
  if (is_nvdb(options)) cost.bytes += nvdb_bytes(recipe, plan);
  const openvdb::Coord voxels = plan.voxels.dim();
  options.require_cost(fmt::format("{} x {} x {} voxels", voxels.x(), voxels.y(), voxels.z()),
                       {cost.seconds / threads, cost.bytes},
                       plan.modification ? "" : "make --dim smaller or --voxel larger");
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
                             ": exists already, and is damaged or of another recipe; --force instead of "
                             "--skip-existing replaces it");
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

}  // namespace

void make_volume_files(const MakeOptions& options, UsdScene* scene) {
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
  if (is_empty(volume) && options.part.whole() && !options.quiet) {
    std::cerr << "vdbnoise: warning: the volume is empty: no voxel of it has a density; another --seed, a "
                 "higher --frequency or another shape may have some\n";
  }
  if (options.recipe.band_limit && is_zero(volume) && !options.quiet) {
    std::cerr << "vdbnoise: warning: --band-limit leaves nothing of the noise, all of whose frequencies are "
                 "above what the voxels hold; make --frequency lower or --voxel smaller\n";
  } else if (!options.recipe.modification && is_constant(volume) && options.part.whole() && !options.quiet) {
    std::cerr
        << "vdbnoise: warning: all voxels have the same value: the noise's waves are far longer than the "
           "volume, or its impulses too rare to reach it; make --frequency or --impulses higher\n";
  }
  if (!options.quiet) print_statistics(volume, options.out.empty() ? options.preview : options.out);
}

namespace {

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

}  // namespace

void measure_density_factors(MakeOptions& options) {
  const std::vector<VolumeRecipe> singles = recipes_of_grids(options.recipe);
  for (std::size_t i = 0; i < singles.size(); ++i) {
    if (!measures_density(singles[i])) continue;
    grid_of(options.recipe, i).density.factor = measure_sequence(options, singles[i]);
  }
}

}  // namespace solidnoise
