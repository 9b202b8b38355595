#pragma once

#include <string>
#include <vector>

#include "common/run_options.h"

namespace solidnoise {

// Joins the files of a volume's parts to one, with a picture unless `preview` is empty; both appear, or
// neither. For a process that has called catch_interrupts().
void merge_files(const std::vector<std::string>& parts, const std::string& out, const std::string& preview,
                 const RunOptions& options);

}  // namespace solidnoise
