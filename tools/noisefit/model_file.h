#pragma once

#include <filesystem>
#include <string>

#include "solidnoise/core/output_file.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// A spectrum file. Throws std::runtime_error that names the path.
ExemplarModel read_model(const std::filesystem::path& path);

// Writes one, all or nothing; "-" is the standard output.
void write_model(const std::filesystem::path& path, const ExemplarModel& model, Existing existing);

// Ends a fit that was interrupted: writes its last solution, if `path` is not empty, says so on the standard
// error and returns the exit status.
int keep_last_solution(const std::string& path, const ExemplarModel& model, Existing existing);

}  // namespace solidnoise
