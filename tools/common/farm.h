#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/farm_job.h"
#include "common/flag_set.h"
#include "common/run_tool.h"

namespace solidnoise {

// A task of a step, both counted from 0.
struct FarmTask {
  std::size_t step = 0;
  int number = 0;
};

// What a job is to be, as the command line says it.
struct FarmPlan {
  FarmOptions options;
  int threads = 1;        // of a task
  bool replaces = false;  // a job's folder that exists
  std::string out;        // after which the folder is called unless the options say
  std::string recipe;     // that the flags override, for the folder to keep: presets and files may change
  std::vector<FarmStep> steps;  // names, numbers and estimates of tasks
};

// What the jobs of a tool make. Each task makes files, whole or not at all, from what the command line names
// and from what the steps before have made; they are the same whichever machine does it, and however often.
class FarmWork {
 public:
  virtual ~FarmWork() = default;

  // Refuses also what could not be written in the end. Throws as require_outputs().
  virtual FarmPlan plan() const = 0;

  // Of a job that exists:
  virtual std::string name_of(const FarmTask& task) const = 0;  // "frame 17, part 3 of 8"
  virtual std::vector<std::filesystem::path> files_of(const FarmTask& task) const = 0;
  // Whether its files are there and of this job; thorough: also that they are whole, for which they are read.
  enum class Check { quick, thorough };
  virtual bool is_done(const FarmTask& task, Check check) const = 0;
  // Makes them, in the place of what is there.
  virtual void run(const FarmTask& task) = 0;
};

// A job that exists: its folder, and the recipe that it keeps.
struct FarmPlace {
  std::filesystem::path folder;
  std::string recipe;
};

// The commands of a tool for farms. A tool makes its work of the arguments of the command; `place` is null
// where the job is a new one.
using MakeFarmWork = std::unique_ptr<FarmWork> (*)(const std::vector<std::string>& arguments,
                                                   const FarmPlace* place);

// `farm ...`: writes the job's folder, and submits it if that is asked for.
int create_farm_job(MakeFarmWork make_work, const std::vector<std::string>& arguments);
// `farm run FOLDER STEP JOB`: does those tasks of a job that are not done. What it says is for a log and for
// what reads it: "openjd_status: ..." and "OUTPUT_FILE: PATH" of each task, "openjd_progress: PERCENT".
int run_farm_job(MakeFarmWork make_work, const std::vector<std::string>& arguments);
// `farm status FOLDER`: prints what is done, by the files.
int print_farm_status(MakeFarmWork make_work, const std::vector<std::string>& arguments);

// The command of a tool that is any of these.
template <MakeFarmWork make_work>
int run_farm_command(const std::string& tool, const std::vector<std::string>& arguments) {
  using Arguments = std::vector<std::string>;
  constexpr Command kCommands[] = {
      {"run", [](const Arguments& rest) { return run_farm_job(make_work, rest); }},
      {"status", [](const Arguments& rest) { return print_farm_status(make_work, rest); }}};
  return run_commands(tool + " farm", kCommands, arguments,
                      [](const Arguments& rest) { return create_farm_job(make_work, rest); });
}

// Declares the flags of FarmOptions but --parts.
void declare_farm_flags(FlagSet& flags, FarmOptions& options);

}  // namespace solidnoise
