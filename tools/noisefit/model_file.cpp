#include "noisefit/model_file.h"

#include <iostream>

#include <fmt/format.h>

#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

ExemplarModel read_model(const std::filesystem::path& path) {
  ExemplarModel model;
  read_recipe(path, read_text_file(path), [&](const Json& json) { model = exemplar_file_from_json(json); });
  return model;
}

void write_model(const std::filesystem::path& path, const ExemplarModel& model, Existing existing) {
  const std::string text = format_json(exemplar_file_to_json(model));
  write_output(path, {.existing = existing}, [&](std::ostream& stream) { stream << text; });
}

int keep_last_solution(const std::string& path, const ExemplarModel& model, Existing existing) {
  if (!path.empty()) write_model(path, model, existing);
  std::cerr << fmt::format("noisefit: interrupted; {}\n",
                           path.empty() ? "nothing is written" : path + " has the last solution");
  return kInterrupted + interrupt_signal();
}

}  // namespace solidnoise
