#include "solidnoise/recipe/exemplar_file.h"

#include <nlohmann/json.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/recipe/exemplar_model_json.h"

namespace solidnoise {

std::optional<double> ExemplarFile::true_frequency() const {
  if (!pixel_size) return std::nullopt;
  return model.principal_frequency();
}

Json to_json(const ExemplarFile& file) {
  Json json = exemplar_file_to_json(file.model);
  if (file.pixel_size) json["pixel_size"] = *file.pixel_size;
  return json;
}

ExemplarFile exemplar_file_of(const Json& json) {
  ExemplarFile file{exemplar_file_from_json(json), {}};
  if (!json.contains("pixel_size")) return file;
  JsonReader reader(json);
  double size = 0.0;
  reader.read("pixel_size", size);
  require_in_range("pixel_size", size, 1e-9, 1e9, "world units");
  file.pixel_size = size;
  return file;
}

}  // namespace solidnoise
