#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/farm.h"
#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_tool.h"
#include "meshnoise/bake_arguments.h"
#include "meshnoise/bake_file.h"
#include "meshnoise/commands.h"
#include "meshnoise/recipe_source.h"
#include "solidnoise/core/digest.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr char kFarmDescription[] =
    "Has many machines bake a sequence: writes a folder with the job for Slurm and for managers of Open Job\n"
    "Description. All flags of meshnoise bake say what to make.\n"
    "  meshnoise farm in.####.ply --frames 1-240 --out out.####.ply --submit   a job of frames\n"
    "  meshnoise farm status out.farm                                          says what is done";

// Meshes do not all say what they were made of: the job's folder has a record of each that is done.
class BakeFarm final : public FarmWork {
 public:
  BakeFarm(const std::vector<std::string>& arguments, const FarmPlace* place)
      : read_("meshnoise farm", kFarmDescription) {
    declare_farm_flags(read_.flags, farm_);
    read_.flags.show_first({"--out", "--preset", "--frames", "--folder", "--threads", "--max-memory",
                            "--at-once", "--job-time", "--most-jobs", "--submit"});
    read_.flags.parse(arguments);
    if (place) {
      folder_ = place->folder;
      read_recipe(folder_ / "recipe.json", place->recipe,
                  [&](const Json& json) { start_ = bake_recipe_from_json(json); });
    } else {
      start_ = choose_bake_recipe(read_.flags);
    }
    read_.apply(start_);
    BakeOptions& options = read_.options;
    read_.flags.refuse({"--uv"},
                       "is not for a farm's job, which makes meshes; meshnoise bake makes textures");
    if (options.out.empty()) throw UsageError("--out is missing; say where meshes go: --out out.####.ply");
    if (options.out == "-" || read_.in == "-") throw UsageError("a farm needs files, such as out.####.ply");
    read_.flags.refuse({"--write-recipe", "--describe", "--timings"},
                       "is not for a farm's job; leave it out");
    options.threads = options.threads.value_or(1);
    if (!place) return;
    options.force = true;  // what is not as it should be is made again
    options.logs = true;
  }

  FarmPlan plan() const override {
    const BakeOptions& options = read_.options;
    return explained(read_.flags, [&] {
      for (std::size_t i = 0; i < frame_count(read_); ++i) check_outputs(read_.flags, frame_of(read_, i));
      const BakeFrame first = frame_of(read_, 0);
      const Cost cost = bake_cost(plan_frame(first), first.options.recipe);
      const FarmStep step{"frames", static_cast<int>(frame_count(read_)), cost.seconds / *options.threads,
                          cost.bytes};
      return FarmPlan{farm_, *options.threads, options.force, options.out, format_json(to_json(start_)),
                      {step}};
    });
  }

  std::string name_of(const FarmTask& task) const override {
    const std::vector<int>& frames = read_.options.frames;
    return frames.empty() ? "the mesh"
                          : fmt::format("frame {}", frames[static_cast<std::size_t>(task.number)]);
  }

  std::vector<fs::path> files_of(const FarmTask& task) const override {
    const BakeOptions options = frame(task).options;
    std::vector<fs::path> files{options.out};
    if (options.usd) files.push_back(usd_path(options.out));
    if (!options.preview.empty()) files.push_back(options.preview);
    return files;
  }

  bool is_done(const FarmTask& task, Check check) const override {
    if (!fs::exists(record_of(task))) return false;
    const Json record = parse_json(read_text_file(record_of(task)));
    const auto is_there = [](const fs::path& file) { return fs::exists(file); };
    const std::vector<fs::path> files = files_of(task);
    if (!std::all_of(files.begin(), files.end(), is_there)) return false;
    return check == Check::quick ? record.value("job", "") == job_digest() : record == make_record(task);
  }

  void run(const FarmTask& task) override {
    const auto threads = read_.options.limit_threads();
    bake_frame(frame(task));
    write_text_file(record_of(task), format_json(make_record(task)), {.existing = Existing::replace});
  }

 private:
  BakeFrame frame(const FarmTask& task) const {
    return frame_of(read_, static_cast<std::size_t>(task.number));
  }

  fs::path record_of(const FarmTask& task) const {
    return folder_ / "parts" / fmt::format("{:04}.json", task.number + 1);
  }

  // Of the recipe, with the flags in it, and of what else decides what files hold.
  std::string job_digest() const {
    const BakeOptions& options = read_.options;
    Json json = to_json(read_.options.recipe);
    json["files"] = {read_.in, options.out, options.preview, options.rest, options.rest_property};
    json["keep"] = options.keep;
    json["fps"] = options.fps;
    json["view"] = {options.view.size, options.view.turn, options.view.elevation};
    json["usd"] = options.usd;
    return digest(kMeshnoise + format_json(json));
  }

  // Digests: of the job, of what the frame is made of, and of its files.
  Json make_record(const FarmTask& task) const {
    const BakeFrame of = frame(task);
    Json record = {{"job", job_digest()}, {"in", file_digest(of.in)}};
    if (!of.options.rest.empty()) record["rest"] = file_digest(of.options.rest);
    for (const fs::path& file : files_of(task)) record["files"].push_back(file_digest(file));
    return record;
  }

  BakeArguments read_;
  FarmOptions farm_;
  BakeRecipe start_;
  fs::path folder_;  // of a job that exists
};

std::unique_ptr<FarmWork> make_work(const std::vector<std::string>& arguments, const FarmPlace* place) {
  return std::make_unique<BakeFarm>(arguments, place);
}

}  // namespace

int run_farm(const std::vector<std::string>& arguments) {
  return run_farm_command<make_work>("meshnoise", arguments);
}

}  // namespace solidnoise
