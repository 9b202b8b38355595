#include "common/farm.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/farm_scripts.h"
#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr char kRecipe[] = "recipe.json";

fs::path folder_of(const FarmPlan& plan) {
  if (!plan.options.folder.empty()) return fs::absolute(plan.options.folder).lexically_normal();
  std::string name = fs::path(plan.out).stem().string();  // "sky.####"
  name.erase(std::find_if(name.begin(), name.end(), [](char c) { return c == '#' || c == '%'; }), name.end());
  while (!name.empty() && (name.back() == '.' || name.back() == '_' || name.back() == '-')) name.pop_back();
  return fs::absolute(fs::path(plan.out).replace_filename((name.empty() ? "job" : name) + ".farm"))
      .lexically_normal();
}

fs::path this_program() {
  return fs::read_symlink("/proc/self/exe");
}

// Whether a program is on the path.
bool is_there(const char* program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

void submit(const fs::path& folder) {
  const fs::path script = folder / "submit.sh";
  if (!is_there("sbatch")) {
    throw std::runtime_error(
        fmt::format("there is no sbatch here; {} is the job, whole: run {} on a machine that has it, or give "
                    "{} to a manager of Open Job Description",
                    folder.string(), script.string(), (folder / "template.json").string()));
  }
  std::string path = script.string();
  char* const arguments[] = {path.data(), nullptr};
  pid_t child = 0;
  int status = posix_spawn(&child, path.c_str(), nullptr, nullptr, arguments, environ);
  if (status == 0) waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error(path + ": sbatch has refused the job");
}

// Writes all of a job's files, or none; folders of its own are there before.
void write_job(const FarmJob& job, const FarmPlan& plan) {
  const Existing existing = plan.replaces ? Existing::replace : Existing::refuse;
  std::vector<fs::path> made;  // folders
  try {
    for (const fs::path& folder : {job.folder, job.folder / "parts", job.folder / "log"}) {
      if (fs::create_directories(folder)) made.push_back(folder);
    }
    OutputGroup files;
    const auto write = [&](const std::string& name, const std::string& text) {
      write_text_file(job.folder / name, text, {.existing = existing, .group = &files});
    };
    write("job.json", format_farm_job(job));
    write(kRecipe, plan.recipe);
    for (const FarmStep& step : job.steps) write(step.name + ".sbatch", sbatch_script(job, step));
    write("submit.sh", submit_script(job));
    write("template.json", open_job_template(job));
    files.appear();
    fs::permissions(job.folder / "submit.sh", fs::perms::owner_exec | fs::perms::group_exec,
                    fs::perm_options::add);
  } catch (...) {
    std::error_code error;
    while (!made.empty()) {
      fs::remove(made.back(), error);
      made.pop_back();
    }
    throw;
  }
}

}  // namespace

void declare_farm_flags(FlagSet& flags, FarmOptions& options) {
  flags.group("Farm");
  flags.keep("--folder", "FOLDER", "Where the job goes; without it beside --out, as NAME.farm",
             options.folder);
  declare_fields(flags, options, {"at_once", "job_time", "most_jobs", "submit"});
}

int create_farm_job(MakeFarmWork make_work, const std::vector<std::string>& arguments) {
  const FarmPlan plan = make_work(arguments, nullptr)->plan();
  FarmJob job;
  job.folder = folder_of(plan);
  job.program = this_program();
  job.directory = fs::current_path();
  job.arguments = arguments;
  job.steps = plan.steps;
  job.threads = plan.threads;
  job.at_once = plan.options.at_once;
  chunk_tasks(plan.options, job.steps);
  for (const std::string& name : {job.folder.string(), job.directory.string()}) {
    if (std::ranges::none_of(name, [](char c) { return c >= 0 && c < ' '; })) continue;
    throw std::runtime_error(fmt::format(
        "{} has control characters in its name, which a job's scripts cannot hold", printable(name)));
  }
  if (!plan.replaces && fs::exists(job.folder / "job.json")) {
    throw std::runtime_error(fmt::format(
        "{} has a job already; --force replaces it, and keeps what is made already of the same recipe",
        job.folder.string()));
  }
  write_job(job, plan);
  for (const FarmStep& step : job.steps) {
    std::cerr << fmt::format("{}: {} tasks in {} jobs, {:.3g} s and {:.3g} MB each by estimate\n", step.name,
                             step.tasks, step.jobs(), step.seconds, 1e-6 * step.bytes);
  }
  if (plan.options.submit) {
    submit(job.folder);
  } else {
    std::cerr << fmt::format("{} is for Slurm, template.json in it for Open Job Description\n",
                             (job.folder / "submit.sh").string());
  }
  return kDone;
}

namespace {

std::string command_named(const char* name) {
  return fmt::format("{} farm {}", program_invocation_short_name, name);
}

// A job that exists, and its work; the process then is where the command was given.
struct OpenJob {
  OpenJob(const std::string& folder, MakeFarmWork make_work) : job(read_farm_job(folder)) {
    const std::string program = job.program.filename().string();
    if (program != this_program().filename()) {
      throw UsageError(fmt::format("FOLDER is {}, a job of {}; give it to {} farm", printable(folder),
                                   printable(program), printable(program)));
    }
    fs::current_path(job.directory);
    const FarmPlace place{job.folder, read_text_file(job.folder / kRecipe)};
    work = make_work(job.arguments, &place);
  }

  FarmJob job;
  std::unique_ptr<FarmWork> work;
};

std::size_t find_step(const FarmJob& job, const std::string& name) {
  std::vector<std::string> names;
  for (const FarmStep& step : job.steps) {
    if (step.name == name) return names.size();
    names.push_back(step.name);
  }
  throw UsageError(fmt::format("STEP is {}; the job has {}", printable(name), fmt::join(names, ", ")));
}

// To the standard output, at once: managers of jobs read it line by line.
void say(const std::string& line) {
  std::fputs((line + '\n').c_str(), stdout);
  std::fflush(stdout);
}

void run_task(const FarmJob& job, FarmWork& work, const FarmTask& task) {
  const FarmStep& step = job.steps[task.step];
  const bool is_kept = work.is_done(task, FarmWork::Check::thorough);
  say(fmt::format("openjd_status: {} {} of {}, {}{}", step.name, task.number + 1, step.tasks,
                  work.name_of(task), is_kept ? ": is done already" : ""));
  if (!is_kept) work.run(task);
  for (const fs::path& file : work.files_of(task)) say("OUTPUT_FILE: " + fs::absolute(file).string());
}

}  // namespace

int run_farm_job(MakeFarmWork make_work, const std::vector<std::string>& arguments) {
  std::string folder;
  std::string step;
  std::string number;
  FlagSet flags(command_named("run"),
                "Does those tasks of a job that are not done: what the scripts of a farm's folder call.");
  flags.argument("FOLDER", "The job's folder", folder);
  flags.argument("STEP", "One of its steps, as job.json has them", step);
  flags.argument("JOB", "One of the step's jobs, from 1", number);
  flags.parse(arguments);
  flags.apply();
  const OpenJob open(folder, make_work);
  const std::size_t index = find_step(open.job, step);
  const FarmStep& of = open.job.steps[index];
  const int which = parse_integer("JOB", number);
  if (which < 1 || which > of.jobs()) {
    throw UsageError(fmt::format("JOB is {}; it must be between 1 and {}", which, of.jobs()));
  }
  catch_interrupts();
  const int first = (which - 1) * of.tasks_per_job;
  const int end = std::min(of.tasks, first + of.tasks_per_job);
  int done = 0;
  for (int task = first; task < end; ++task) {
    try {
      run_task(open.job, *open.work, {index, task});
      ++done;
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      std::cerr << fmt::format("{}: {} {}: {}\n", program_invocation_short_name, step, task + 1,
                               error.what());
    }
    say(fmt::format("openjd_progress: {:.0f}", 100.0 * done / (end - first)));
  }
  const int all = end - first;
  if (done < all) throw std::runtime_error(fmt::format("{} of {} tasks failed", all - done, all));
  return kDone;
}

namespace {

// "4, 7-9, 60"
std::string ranges_of(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[first]);
    if (last > first) text += '-' + std::to_string(numbers[last]);
    first = last + 1;
  }
  return text;
}

}  // namespace

int print_farm_status(MakeFarmWork make_work, const std::vector<std::string>& arguments) {
  std::string folder;
  FlagSet flags(command_named("status"), "Prints what of a job is done, by the files that are there.");
  flags.argument("FOLDER", "The job's folder", folder);
  flags.parse(arguments);
  flags.apply();
  const OpenJob open(folder, make_work);
  for (std::size_t step = 0; step < open.job.steps.size(); ++step) {
    const FarmStep& of = open.job.steps[step];
    std::vector<int> missing;
    for (int task = 0; task < of.tasks; ++task) {
      if (!open.work->is_done({step, task}, FarmWork::Check::quick)) missing.push_back(task + 1);
    }
    std::cout << fmt::format("{}: {} of {} done{}\n", of.name, of.tasks - static_cast<int>(missing.size()),
                             of.tasks, missing.empty() ? "" : "; not " + ranges_of(missing));
  }
  return kDone;
}

}  // namespace solidnoise
