#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/image.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/recipe/exemplar_file.h"

namespace solidnoise {

// A spectrum file; "-" is the standard input. Throws std::runtime_error that names the path.
ExemplarFile read_model(const std::filesystem::path& path);

// Writes one, all or nothing; "-" is the standard output.
void write_model(const std::filesystem::path& path, const ExemplarFile& file, const OutputOptions& options);

// The wavelength at the model's principal frequency: in pixels, and in world units where they are known.
std::string describe_scale(const ExemplarFile& file);

void print_warnings(const std::vector<std::string>& warnings);

// Where a fit is written: the model, and a picture of it. Either may be empty, but not both.
struct FitOutputs {
  std::string model;
  std::string preview;
  std::optional<double> pixel_size;  // of the exemplar, where it is known
  Existing existing = Existing::refuse;

  // Refuses, before any work, what could not be written in the end, and what is one of the inputs. Throws
  // UsageError, std::runtime_error.
  void check(const std::vector<std::string>& inputs) const;
  // Writes both together; the picture is drawn if there is to be one.
  void write(const ExemplarModel& fitted, const std::function<Image()>& draw) const;
};

// Ends a fit that was interrupted: writes its last solution, if models are written, says so on the standard
// error and returns the exit status.
int keep_last_solution(const FitOutputs& outputs, const ExemplarModel& model);

}  // namespace solidnoise
