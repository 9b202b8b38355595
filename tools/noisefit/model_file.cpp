#include "noisefit/model_file.h"

#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/outputs.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

ExemplarFile read_model(const std::filesystem::path& path) {
  ExemplarFile file;
  read_recipe(path, read_text_file(path == "-" ? "/dev/stdin" : path),
              [&](const Json& json) { file = exemplar_file_of(json); });
  return file;
}

void write_model(const std::filesystem::path& path, const ExemplarFile& file, const OutputOptions& options) {
  write_text_file(path, format_json(to_json(file)), options);
}

std::string describe_scale(const ExemplarFile& file) {
  const double wavelength = 1.0 / file.model.principal_frequency();
  if (!file.pixel_size) {
    return fmt::format("principal wavelength: {:.3g} pixels, of no known size (--pixel-size)\n", wavelength);
  }
  return fmt::format("principal wavelength: {:.3g} pixels, {:.3g} units\n", wavelength / *file.pixel_size,
                     wavelength);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << fmt::format("noisefit: warning: {}\n", warning);
}

void FitOutputs::check(const std::vector<std::string>& inputs) const {
  if (model.empty() && preview.empty()) {
    throw UsageError("--out is missing; say where the noise goes: --out sand.json");
  }
  require_extension("--out", model, {".json"}, StandardOutput::allowed);
  require_extension("--preview", preview, {".png", ".jpg", ".tif", ".exr"}, StandardOutput::refused);
  require_outputs({model, preview}, existing, inputs);
}

void FitOutputs::write(const ExemplarModel& fitted, const std::function<Image()>& draw) const {
  OutputGroup group;
  if (!preview.empty()) write_image(preview, draw(), {.existing = existing, .group = &group});
  if (!model.empty()) write_model(model, {fitted, pixel_size}, {.existing = existing, .group = &group});
  group.appear();
}

int keep_last_solution(const FitOutputs& outputs, const ExemplarModel& model) {
  if (!outputs.model.empty())
    write_model(outputs.model, {model, outputs.pixel_size}, {.existing = outputs.existing});
  std::cerr << fmt::format("noisefit: interrupted; {}\n", outputs.model.empty()
                                                              ? "nothing is written"
                                                              : outputs.model + " has the last solution");
  return kInterrupted + interrupt_signal();
}

}  // namespace solidnoise
