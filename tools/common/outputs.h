#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/output_file.h"

namespace solidnoise {

// Refuses a file that could not be written in the end, before any work. "-" always passes. Throws
// std::runtime_error naming the path, and --force where that would help.
void require_output(const std::string& path, Existing existing);

// The same for all outputs of a run; empty ones are none. Throws UsageError if two of them are one file.
void require_outputs(const std::vector<std::string>& paths, Existing existing);

}  // namespace solidnoise
