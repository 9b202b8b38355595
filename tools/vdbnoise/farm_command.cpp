#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/farm.h"
#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_tool.h"
#include "solidnoise/recipe/recipe_file.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/stream_volume.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/make_arguments.h"
#include "vdbnoise/make_files.h"
#include "vdbnoise/merge_files.h"
#include "vdbnoise/nvdb_output.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr char kFarmDescription[] =
    "Has many machines make a volume, or a sequence: writes a folder with the job for Slurm and for managers "
    "of\nOpen Job Description. All flags of vdbnoise say what to make; RECIPE.json before them is "
    "--recipe's.\n"
    "  vdbnoise farm --preset cumulus --dim 2048 --parts 64 --out sky.vdb --submit   parts, and their "
    "merging\n"
    "  vdbnoise farm boil.json --frames 1-240 --out boil.####.vdb                    a job of frames\n"
    "  vdbnoise farm status sky.farm                                                 says what is done";

// The steps: of a sequence whose densities have one scale, that; volumes, or their parts, and these joined.
constexpr char kScale[] = "scale";
constexpr char kFrames[] = "frames";
constexpr char kParts[] = "parts";
constexpr char kMerge[] = "merge";

std::vector<std::string> with_recipe_flag(std::vector<std::string> arguments) {
  if (!arguments.empty() && !arguments.front().empty() && arguments.front().front() != '-') {
    arguments.insert(arguments.begin(), "--recipe");
  }
  return arguments;
}

class VolumeFarm final : public FarmWork {
 public:
  VolumeFarm(const std::vector<std::string>& arguments, const FarmPlace* place)
      : read_("vdbnoise farm", kFarmDescription) {
    declare_farm_flags(read_.flags, farm_);
    declare_fields(read_.flags, farm_, {"parts"});
    read_.flags.show_first({"--out", "--preset", "--dim", "--frames", "--parts", "--folder", "--threads",
                            "--max-memory", "--at-once", "--job-time", "--most-jobs", "--submit"});
    read_.flags.parse(with_recipe_flag(arguments));
    if (place) {
      folder_ = place->folder;
      read_recipe(folder_ / "recipe.json", place->recipe,
                  [&](const Json& json) { start_ = volume_recipe_from_json(json); });
    } else {
      start_ = explained(read_.flags, [&] { return read_.start(); });
    }
    read_.apply(start_);
    check();
    options_ = read_.options;
    scale_digest_ = digest(format_json(to_json(options_.recipe)));
    options_.threads = options_.threads.value_or(1);
    has_scale_ = !options_.frames.empty() && shares_density_factor(options_);
    if (has_scale_) kinds_.push_back(kScale);
    kinds_.push_back(farm_.parts > 1 ? kParts : kFrames);
    if (farm_.parts > 1) kinds_.push_back(kMerge);
    if (!place) return;
    options_.force = true;  // what is not as it should be is made again
    options_.logs = true;
    take_scale();
  }

  FarmPlan plan() const override {
    for (int frame = 0; frame < frame_count(); ++frame) {
      require_outputs({of_frame(frame).out}, options_.existing());
    }
    FarmPlan plan{farm_, *options_.threads, options_.force, options_.out, format_json(to_json(start_)), {}};
    return explained(read_.flags, [&] {
      const MakeOptions first = of_frame(0);
      const VolumePlan whole = plan_volume(first.recipe);
      const VolumePlan part = plan_volume(first.recipe, part_of(0));
      if (!options_.quiet) warn_of_resolution(first.recipe, whole, std::cerr);
      for (const std::string& kind : kinds_) plan.steps.push_back(estimate(kind, first.recipe, whole, part));
      return plan;
    });
  }

  std::string name_of(const FarmTask& task) const override {
    if (kinds_[task.step] == kScale) return "the factor of all frames' densities";
    const int frame = frame_of(task);
    std::string name = options_.frames.empty() ? "the volume" : fmt::format("frame {}", number_of(frame));
    if (kinds_[task.step] == kParts) {
      name += fmt::format(", part {} of {}", task.number % farm_.parts + 1, farm_.parts);
    }
    return name;
  }

  std::vector<fs::path> files_of(const FarmTask& task) const override { return {file_of(task)}; }

  bool is_done(const FarmTask& task, Check check) const override {
    if (kinds_[task.step] == kScale) return has_factors();
    const fs::path file = file_of(task);
    if (!fs::exists(file)) return false;
    const MakeOptions options = of(task);
    return holds_volume(file, options.recipe, plan_volume(options.recipe, options.part),
                        check == Check::quick ? Reading::headers : Reading::all);
  }

  void run(const FarmTask& task) override {
    const auto threads = options_.limit_threads();
    const std::string& kind = kinds_[task.step];
    if (kind == kScale) return write_scale();
    if (has_scale_ && !has_factors()) {
      throw std::runtime_error(scale_file().string() + ": is not there, which the step scale makes");
    }
    const MakeOptions options = of(task);
    if (kind != kMerge) return make_volume_files(options);
    std::vector<std::string> parts;
    for (int part = 0; part < farm_.parts; ++part) parts.push_back(part_file(task.number, part).string());
    merge_files(parts, options.out, {}, options);
  }

 private:
  void check() const {
    const MakeOptions& options = read_.options;
    if (options.out.empty()) throw UsageError("--out is missing; say where volumes go: --out sky.vdb");
    if (options.out == "-" || is_nvdb(options)) {
      throw UsageError(fmt::format("--out is {}; a farm makes .vdb files", options.out));
    }
    check_output_names(options.out, {});
    read_.flags.refuse({"--preview", "--preview-frame", "--usd", "--write-recipe", "--describe", "--shard",
                        "--region", "--skip-existing", "--timings"},
                       "is not for a farm's job; leave it out");
    if (farm_.parts > 1 && options.recipe.modification) {
      throw UsageError("--parts cuts volumes that are made; leave it out with --on");
    }
  }

  int frame_count() const { return std::max(1, static_cast<int>(options_.frames.size())); }
  int number_of(int frame) const { return options_.frames[static_cast<std::size_t>(frame)]; }
  VolumePart part_of(int part) const { return {.shard = part + 1, .shards = farm_.parts}; }

  int frame_of(const FarmTask& task) const {
    return kinds_[task.step] == kParts ? task.number / farm_.parts : task.number;
  }

  MakeOptions of_frame(int frame) const {
    return options_.frames.empty() ? options_ : options_of_frame(options_, static_cast<std::size_t>(frame));
  }

  fs::path scale_file() const { return folder_ / "scale.json"; }

  fs::path part_file(int frame, int part) const {
    const std::string stem = fs::path(of_frame(frame).out).stem().string();
    const std::size_t width = std::to_string(farm_.parts).size();
    return folder_ / "parts" / fmt::format("{}.part{:0{}}.vdb", stem, part + 1, width);
  }

  fs::path file_of(const FarmTask& task) const {
    const std::string& kind = kinds_[task.step];
    if (kind == kScale) return scale_file();
    if (kind == kParts) return part_file(frame_of(task), task.number % farm_.parts);
    return of_frame(task.number).out;
  }

  MakeOptions of(const FarmTask& task) const {
    MakeOptions options = of_frame(frame_of(task));
    options.out = file_of(task).string();
    if (kinds_[task.step] == kParts) options.part = part_of(task.number % farm_.parts);
    return options;
  }

  FarmStep estimate(const std::string& kind, const VolumeRecipe& recipe, const VolumePlan& whole,
                    const VolumePlan& part) const {
    const int threads = *options_.threads;
    if (kind == kScale) {
      const Cost cost = volume_cost(recipe, whole, threads, Making::streamed);
      return {kind, 1, cost.seconds / passes_of_stream(recipe) / threads, cost.bytes};
    }
    if (kind == kMerge) {
      const Cost cost = merge_cost(recipe, whole, farm_.parts);
      return {kind, frame_count(), cost.seconds, cost.bytes};
    }
    const double memory = options_.max_memory ? static_cast<double>(options_.max_memory->bytes) : 0.0;
    const Cost cost = plan_making(recipe, part, threads, memory, Target::file).cost;
    return {kind, frame_count() * farm_.parts, cost.seconds / threads, cost.bytes};
  }

  // What the step "scale" measures: a number for each grid, or null; nothing where that is not done.
  Json factors() const {
    if (!fs::exists(scale_file())) return {};
    const Json json = parse_json(read_text_file(scale_file()));
    return json.value("recipe", "") == scale_digest_ ? json.value("factors", Json()) : Json();
  }

  bool has_factors() const { return factors().is_array(); }

  void take_scale() {
    const Json json = factors();
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (json[i].is_number()) grid_of(options_.recipe, i).density.factor = json[i].get<double>();
    }
  }

  void write_scale() {
    measure_density_factors(options_);
    Json json = {{"recipe", scale_digest_}};
    for (const VolumeRecipe& grid : recipes_of_grids(options_.recipe)) {
      json["factors"].push_back(grid.density.factor ? Json(*grid.density.factor) : Json());
    }
    write_text_file(scale_file(), format_json(json), {.existing = Existing::replace});
  }

  MakeArguments read_;
  FarmOptions farm_;
  VolumeRecipe start_;
  MakeOptions options_;
  std::string scale_digest_;  // of the recipe whose densities the factors are of
  bool has_scale_ = false;
  std::vector<std::string> kinds_;  // of the steps
  fs::path folder_;                 // of a job that exists
};

std::unique_ptr<FarmWork> make_work(const std::vector<std::string>& arguments, const FarmPlace* place) {
  return std::make_unique<VolumeFarm>(arguments, place);
}

}  // namespace

int run_farm(const std::vector<std::string>& arguments) {
  return run_farm_command<make_work>("vdbnoise", arguments);
}

}  // namespace solidnoise
