#include "noisefit/model_file.h"

#include <iostream>

#include <fmt/format.h>

#include "common/outputs.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

ExemplarModel read_model(const std::filesystem::path& path) {
  ExemplarModel model;
  read_recipe(path, read_text_file(path), [&](const Json& json) { model = exemplar_file_from_json(json); });
  return model;
}

void write_model(const std::filesystem::path& path, const ExemplarModel& model,
                 const OutputOptions& options) {
  write_text_file(path, format_json(exemplar_file_to_json(model)), options);
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
  if (!model.empty()) write_model(model, fitted, {.existing = existing, .group = &group});
  group.appear();
}

int keep_last_solution(const FitOutputs& outputs, const ExemplarModel& model) {
  if (!outputs.model.empty()) write_model(outputs.model, model, {.existing = outputs.existing});
  std::cerr << fmt::format("noisefit: interrupted; {}\n", outputs.model.empty()
                                                              ? "nothing is written"
                                                              : outputs.model + " has the last solution");
  return kInterrupted + interrupt_signal();
}

}  // namespace solidnoise
