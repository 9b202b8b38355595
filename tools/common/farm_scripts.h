#pragma once

#include <string>

#include "common/farm_job.h"

namespace solidnoise {

// The script of one step for Slurm's sbatch: an array of jobs, 1 to N, at most K at a time (--array=1-N%K).
// What a signal has ended is queued again by Slurm, three times at most.
std::string sbatch_script(const FarmJob& job, const FarmStep& step);

// The script that submits all steps, each after the one before has succeeded (afterok), and prints their
// jobs' ids.
std::string submit_script(const FarmJob& job);

// The same job for other managers: a template of the Open Job Description, 2023-09, as JSON.
std::string open_job_template(const FarmJob& job);

}  // namespace solidnoise
