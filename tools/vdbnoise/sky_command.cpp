#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/sky/sky_grid.h"
#include "solidnoise/volume/sky/sky_plan.h"
#include "solidnoise/volume/sky/sky_scene.h"
#include "solidnoise/volume/usd_scene.h"
#include "solidnoise/volume/volume_cost.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/sky_options.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

// Makes a folder, which does not stay if nothing comes into it.
class KeepsNoEmptyFolder {
 public:
  explicit KeepsNoEmptyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directory(folder_);
  }
  ~KeepsNoEmptyFolder() {
    std::error_code has_files;
    std::filesystem::remove(folder_, has_files);
  }
  KeepsNoEmptyFolder(const KeepsNoEmptyFolder&) = delete;
  KeepsNoEmptyFolder& operator=(const KeepsNoEmptyFolder&) = delete;

 private:
  std::filesystem::path folder_;
};

constexpr char kSkyDescription[] =
    "Makes a sky: a cloud placed at many points, each time with another seed, size and turn. Scattered "
    "points\n"
    "stand where a map of the density lets them, those of a file where it says.\n"
    "  vdbnoise sky --lod-from 0 100 12000 --out sky.usda     500 cumuli, near ones fine, and a scene of "
    "them\n"
    "  vdbnoise sky --points clouds.csv --voxel 20 --out sky.vdb   one grid";

// The files of a set: sky.usda, and sky/cloud_003_1.vdb with its own scene beside it.
class SkyFiles {
 public:
  explicit SkyFiles(const std::string& scene)
      : scene_(scene), folder_(std::filesystem::path(scene).replace_extension()) {}

  const std::filesystem::path& folder() const { return folder_; }
  std::string volume(const SkyCloud& cloud) const { return (folder_ / (cloud.name + ".vdb")).string(); }
  std::string scene(const SkyCloud& cloud) const { return (folder_ / (cloud.name + ".usda")).string(); }
  // As the sky's scene has it.
  std::string relative(const std::string& file) const {
    return (folder_.filename() / std::filesystem::path(file).filename()).string();
  }
  const std::string& scene() const { return scene_; }

 private:
  std::string scene_;
  std::filesystem::path folder_;
};

// All that would be written, before any work.
void require_files(const SkyOptions& options, const SkyPlan& plan) {
  std::vector<OutputPath> outputs{{options.out, {options.inputs.recipe}},
                                  options.write_points,
                                  {options.write_recipe, {options.inputs.recipe}}};
  std::vector<std::string> inputs{options.inputs.recipe, options.inputs.noise};
  if (const auto* const file = std::get_if<PointsFile>(&options.recipe.points)) inputs.push_back(file->file);
  if (options.form() == SkyForm::instances && !options.out.empty()) {
    const SkyFiles files(options.out);
    const bool has_folder = std::filesystem::exists(files.folder());
    if (has_folder && !std::filesystem::is_directory(files.folder()))
      throw std::runtime_error(files.folder().string() + " exists; it must be a folder, for the clouds");
    if (options.skip_existing) outputs.front() = std::string();
    for (const SkyCloud& cloud : plan.clouds) {
      if (!has_folder || options.skip_existing) continue;
      outputs.emplace_back(files.volume(cloud));
      outputs.emplace_back(files.scene(cloud));
    }
  }
  require_outputs(outputs, options.existing(), inputs);
}

void check_cost(const SkyOptions& options, const SkyPlan& plan) {
  const int threads = max_threads();
  const Cost cost = sky_cost(plan, threads);
  options.require_cost(fmt::format("a sky of {} different clouds", plan.clouds.size()),
                       {cost.seconds / threads, cost.bytes}, "make --voxel larger, or --kinds fewer");
}

void warn_of_nothing(const std::string& what) {
  std::cerr << fmt::format(
      "vdbnoise: warning: {} empty: no voxel has a density; a smaller --voxel or another --seed may have "
      "some\n",
      what);
}

class SkyRun {
 public:
  SkyRun(const SkyOptions& options, SkyPlan plan)
      : options_(options), plan_(std::move(plan)), files_(options.out) {}

  void make() {
    if (options_.out.empty()) return write_points({});
    if (options_.form() == SkyForm::grid) return make_grid();
    make_instances();
  }

 private:
  Existing existing() const { return options_.skip_existing ? Existing::replace : options_.existing(); }

  VdbWriteOptions write_options(Progress* progress, OutputGroup* group) const {
    VdbWriteOptions write;
    write.codec = plan_.recipe.cloud.codec;
    write.existing = existing();
    write.creator = kVdbnoise;
    write.progress = progress;
    write.group = group;
    return write;
  }

  void write_points(const std::vector<PlacedFile>& files, OutputGroup* group = nullptr) const {
    if (!options_.write_points.empty()) {
      std::vector<SkyPoint> points;
      for (const SkyInstance& instance : plan_.instances) points.push_back(instance.point);
      write_text_file(options_.write_points, points_text(points, files),
                      {.existing = existing(), .group = group});
    }
    if (!options_.write_recipe.empty()) {
      write_text_file(options_.write_recipe, format_json(to_json(plan_.recipe)),
                      {.existing = existing(), .group = group});
    }
  }

  void make_grid() const {
    Volume sky;
    {
      TaskProgress progress(options_.visibility());
      options_.times->begin("clouds");
      progress.begin("clouds");
      sky = make_sky_grid(plan_, options_.region, kVdbnoise, &progress);
      options_.times->begin("writing");
      progress.begin("writing");
      OutputGroup outputs;
      write_points({}, &outputs);
      write_volume(options_.out, sky, write_options(&progress, &outputs));
      outputs.appear();
    }
    options_.times->begin("end");
    if (options_.quiet) return;
    if (is_empty(sky)) warn_of_nothing("the sky is");
    print_statistics(sky, options_.out);
  }

  // The clouds one after the other, each whole; the scene, which needs all of them, at the end.
  void make_instances() const {
    const KeepsNoEmptyFolder folder(files_.folder());
    std::size_t kept = 0;
    std::vector<std::string> empty;
    for (std::size_t i = 0; i < plan_.clouds.size(); ++i) {
      const SkyCloud& cloud = plan_.clouds[i];
      if (i > 0) {
        set_what_is_left(
            fmt::format("nothing is written of {}; {} before it are", cloud.name, i == 1 ? "that" : "those"));
      }
      if (is_made(cloud)) {
        ++kept;
        continue;
      }
      if (make_cloud(cloud, fmt::format("{} of {}: ", i + 1, plan_.clouds.size())) == Made::nothing)
        empty.push_back(cloud.name);
    }
    options_.times->begin("scene");
    write_scene();
    if (options_.quiet) return;
    if (!empty.empty()) {
      warn_of_nothing(fmt::format("{} of {} clouds, the first of them {}, are", empty.size(),
                                  plan_.clouds.size(), empty.front()));
    }
    std::cerr << fmt::format("{}: {} clouds at {} points{}\n", options_.out, plan_.clouds.size(),
                             plan_.instances.size(), kept > 0 ? fmt::format(", {} kept", kept) : "");
  }

  bool is_made(const SkyCloud& cloud) const {
    const std::string file = files_.volume(cloud);
    return options_.skip_existing && std::filesystem::exists(file) &&
           std::filesystem::exists(files_.scene(cloud)) &&
           holds_volume(file, cloud.recipe, plan_volume(cloud.recipe));
  }

  enum class Made { nothing, cloud };
  Made make_cloud(const SkyCloud& cloud, const std::string& prefix) const {
    TaskProgress progress(options_.visibility());
    options_.times->begin("clouds");
    progress.begin(prefix + "noise");
    const Volume volume = make_sky_cloud(cloud, kVdbnoise, &progress);
    options_.times->begin("writing");
    progress.begin(prefix + "writing");
    const std::string file = files_.volume(cloud);
    OutputGroup outputs;
    write_volume(file, volume, write_options(&progress, &outputs));
    const openvdb::GridCPtrVec grids = grids_of(volume);
    const UsdScene scene{
        .name = cloud.name,
        .up = cloud.recipe.up,
        .fields = usd_fields(grids),
        .frames = {{{}, std::filesystem::path(file).filename().string(), usd_extent(grids)}}};
    write_text_file(files_.scene(cloud), scene.text(), {.existing = existing(), .group = &outputs});
    outputs.appear();
    return is_empty(volume) ? Made::nothing : Made::cloud;
  }

  void write_scene() const {
    std::vector<std::string> scenes;
    for (const SkyCloud& cloud : plan_.clouds) scenes.push_back(files_.relative(files_.scene(cloud)));
    std::vector<PlacedFile> placed;
    for (const SkyInstance& instance : plan_.instances) {
      const SkyCloud& cloud = plan_.clouds[instance.cloud];
      placed.push_back({files_.relative(files_.volume(cloud)), instance.scale});
    }
    OutputGroup outputs;
    write_text_file(options_.out,
                    sky_scene_text(plan_, std::filesystem::path(options_.out).stem().string(), scenes),
                    {.existing = existing(), .group = &outputs});
    write_points(placed, &outputs);
    outputs.appear();
  }

  const SkyOptions& options_;
  SkyPlan plan_;
  SkyFiles files_;
};

// With the scales of its densities, where there is something to be made.
SkyPlan measured(const SkyOptions& options, SkyPlan plan) {
  if (options.out.empty()) return plan;
  TaskProgress progress(options.visibility());
  options.times->begin("density scale");
  progress.begin("density scale");
  measure_densities(plan, &progress);
  return plan;
}

int make(const FlagSet& flags, const SkyOptions& options) {
  catch_interrupts();
  const auto threads = options.limit_threads();
  const SkyPlan plan = [&] {
    const EndsAtOnce ends_at_once;
    SkyPlan all = plan_sky(options.recipe, options.form());
    return options.region ? plan_in(all, *options.region) : all;
  }();
  if (flags.given("--describe")) {
    std::cout << format_json(describe_sky(plan, max_threads()));
    return kDone;
  }
  if (options.out.empty() && options.write_points.empty() && options.write_recipe.empty())
    throw UsageError("--out is missing; say where the sky goes: --out sky.usda");
  require_files(options, plan);
  if (!options.out.empty()) check_cost(options, plan);
  SkyRun(options, measured(options, plan)).make();
  if (options.timings) std::cerr << options.times->report();
  return kDone;
}

}  // namespace

int run_sky(const std::vector<std::string>& arguments) {
  SkyOptions options;
  FlagSet flags("vdbnoise sky", kSkyDescription);
  declare_sky_flags(flags, options);
  flags.parse(arguments);
  return flags.explained([&] {
    options.recipe = choose_sky_recipe(flags);
    options.inputs = recipe_inputs(flags);
    flags.apply();
    check_sky_options(flags, options);
    return make(flags, options);
  });
}

}  // namespace solidnoise
