#pragma once

#include <filesystem>

#include "solidnoise/core/output_file.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// A spectrum file. Throws std::runtime_error that names the path.
ExemplarModel read_model(const std::filesystem::path& path);

// Writes one, all or nothing; "-" is the standard output.
void write_model(const std::filesystem::path& path, const ExemplarModel& model, Existing existing);

}  // namespace solidnoise
