#include "common/farm_scripts.h"

#include <string_view>

#include <fmt/format.h>

namespace solidnoise {
namespace {

// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + '\'';
}

// As a value in a line of #SBATCH that has a file's name, where %a and the like stand for others.
std::string sbatch_path(const std::string& path) {
  std::string value = "\"";
  for (const char c : path) {
    if (c == '"' || c == '\\') value += '\\';
    value += c == '%' ? std::string("%%") : std::string(1, c);
  }
  return value;  // to be closed
}

constexpr std::string_view kTask = R"(status=0
{} farm run {} {} "$SLURM_ARRAY_TASK_ID" || status=$?
# What a signal has ended, for want of memory, say, is tried again.
if ((status > 128 && ${{SLURM_RESTART_COUNT:-0}} < 3)); then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit $status
)";

constexpr std::string_view kSubmit = R"(#!/usr/bin/env bash
# Hands the job to Slurm: each step waits until the one before has succeeded. Run again, it makes what is not there.
set -euo pipefail
cd {}
after=()
for step in {}; do
  id=$(sbatch --parsable "${{after[@]}}" "$step.sbatch")
  echo "$step: job ${{id%%;*}}"
  after=(--dependency="afterok:${{id%%;*}}" --kill-on-invalid-dep=yes)
done
)";

}  // namespace

std::string sbatch_script(const FarmJob& job, const FarmStep& step) {
  std::string text = "#!/usr/bin/env bash\n";
  const auto option = [&](std::string_view name, const std::string& value) {
    text += fmt::format("#SBATCH --{}{}{}\n", name, value.empty() ? "" : "=", value);
  };
  option("job-name", fmt::format("{}-{}", job.name(), step.name));
  option("array", fmt::format("1-{}{}", step.jobs(), job.at_once ? fmt::format("%{}", *job.at_once) : ""));
  option("cpus-per-task", std::to_string(job.threads));
  option("mem", fmt::format("{:.0f}M", step.memory_of_job()));
  option("chdir", sbatch_path(job.directory.string()) + '"');
  option("output", sbatch_path((job.folder / "log" / step.name).string()) + "-%a.log\"");
  option("open-mode", "append");
  option("requeue", "");
  text += fmt::format("# {} tasks, {} in a job.\n", step.tasks, step.tasks_per_job);
  return text + fmt::format(fmt::runtime(kTask), quoted(job.program.string()), quoted(job.folder.string()),
                            step.name);
}

std::string submit_script(const FarmJob& job) {
  std::string steps;
  for (const FarmStep& step : job.steps) steps += (steps.empty() ? "" : " ") + step.name;
  return fmt::format(fmt::runtime(kSubmit), quoted(job.folder.string()), steps);
}

}  // namespace solidnoise
