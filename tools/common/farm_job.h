#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "solidnoise/core/fields.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// What flags say of how a job is cut and queued.
struct FarmOptions {
  std::string folder;            // empty: --out without its extension, and .farm
  int parts = 1;                 // of each volume
  std::optional<int> at_once{};  // jobs of an array that run at a time; none: any number
  double job_time = 60.0;        // seconds
  int most_jobs = 1000;          // of an array
  bool submit = false;
};

constexpr auto fields_of(std::type_identity<FarmOptions>) {
  using Options = FarmOptions;
  return list_fields(field("parts", &Options::parts, between(1, 65536), "",
                           "Parts of about equal cost to make each volume of"),
                     field("at_once", &Options::at_once, between(1, 1000000), "",
                           "Jobs to run at a time; without it, any number"),
                     field("job_time", &Options::job_time, between(0.0, 1e9), "seconds",
                           "Give a job as many tasks as take so long, by the estimate"),
                     field("most_jobs", &Options::most_jobs, between(1, 4000000), "",
                           "Jobs that an array may have: below Slurm's MaxArraySize"),
                     field("submit", &Options::submit, "Hand the job to Slurm by sbatch"));
}

// Tasks of one kind. Those of a step begin when all of the steps before are done.
struct FarmStep {
  std::string name;  // a word: "parts"
  int tasks = 1;
  double seconds = 0.0;   // that one task takes, by estimate
  double bytes = 0.0;     // of memory
  int tasks_per_job = 1;  // that a job of the array does, one after the other

  int jobs() const { return (tasks + tasks_per_job - 1) / tasks_per_job; }
  // MiB of memory that a job asks for: a quarter more than the estimate and 64 MiB for the program itself, as
  // farms end what takes more.
  double memory_of_job() const;
};

// Gives the jobs of each step so many tasks that they last, and that arrays have room for them.
void chunk_tasks(const FarmOptions& options, std::vector<FarmStep>& steps);

// A job for a farm. Its folder has it as job.json; a machine of the farm reads it and runs
// `PROGRAM farm run FOLDER STEP JOB`.
struct FarmJob {
  std::filesystem::path folder;  // absolute, as all here
  std::filesystem::path program;
  std::filesystem::path directory;     // in which the command was given, from which its files are named
  std::vector<std::string> arguments;  // of the command, without "farm"
  std::vector<FarmStep> steps;
  int threads = 1;  // of a task
  std::optional<int> at_once{};

  std::string name() const;  // of the folder, of letters, digits, "_", "-" and "."
};

// The text of job.json, and the job of a folder. The latter throws std::runtime_error that names the file if
// it is not there, or not such a text.
std::string format_farm_job(const FarmJob& job);
FarmJob read_farm_job(const std::filesystem::path& folder);

}  // namespace solidnoise
