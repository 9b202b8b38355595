#include "solidnoise/recipe/exemplar_model_json.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {
namespace {

Json numbers(const Vec<3>& vector) {
  return {vector.x, vector.y, vector.z};
}

Json to_json(const SpectrumBand& band, int dimensions) {
  Json json = Json::object();
  json["a"] = band.a;
  json["components"] = Json::array();
  for (const SpectrumComponent& component : band.components) {
    Json row = Json::array();
    for (int axis = 0; axis < dimensions; ++axis) row.push_back(component.frequency[axis]);
    row.push_back(component.variance);
    row.push_back(component.group);
    json["components"].push_back(std::move(row));
  }
  return json;
}

SpectrumBand band_from_json(JsonReader& reader, int dimensions) {
  SpectrumBand band;
  reader.read("a", band.a);
  std::vector<std::vector<double>> rows;
  const std::size_t axes = static_cast<std::size_t>(dimensions);
  reader.read_rows("components", axes + 2,
                   dimensions == 2 ? "[x, y, variance, group]" : "[x, y, z, variance, group]", rows);
  for (const std::vector<double>& row : rows) {
    SpectrumComponent component;
    for (int axis = 0; axis < dimensions; ++axis) {
      component.frequency[axis] = row[static_cast<std::size_t>(axis)];
    }
    component.variance = row[axes];
    // A number that no group can have is refused when the spectrum is validated.
    const double group = row[axes + 1];
    const bool is_index = group >= 0.0 && group <= 1e6 && group == std::floor(group);
    component.group = is_index ? static_cast<int>(group) : -1;
    band.components.push_back(component);
  }
  reader.finish();
  return band;
}

Json to_json(const GaborSpectrum& spectrum, const Vec<3>& axis) {
  Json json = Json::object();
  json["axis"] = numbers(axis);
  json["dimensions"] = spectrum.dimensions;
  json["isotropic"] = spectrum.isotropic;
  json["groups"] = spectrum.groups;
  json["bands"] = Json::array();
  for (const SpectrumBand& band : spectrum.bands) json["bands"].push_back(to_json(band, spectrum.dimensions));
  return json;
}

GaborSpectrum spectrum_from_json(JsonReader& reader, Vec<3>& axis) {
  GaborSpectrum spectrum;
  reader.read("axis", axis);
  reader.read("dimensions", spectrum.dimensions);
  if (spectrum.dimensions != 2 && spectrum.dimensions != 3) reader.validate(spectrum);
  reader.read("isotropic", spectrum.isotropic);
  reader.read("groups", spectrum.groups);
  for (JsonReader& band : reader.objects("bands")) {
    spectrum.bands.push_back(band_from_json(band, spectrum.dimensions));
  }
  reader.finish();
  reader.validate(spectrum);
  return spectrum;
}

}  // namespace

Json to_json(const ExemplarModel& model) {
  Json json = Json::object();
  json["raw_values"] = model.raw_values;
  if (model.squares) json["squares"] = true;
  json["mean"] = numbers(model.mean);
  json["channels"] = Json::array();
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    json["channels"].push_back(to_json(model.channels[k], model.axes[k]));
  }
  return json;
}

ExemplarModel exemplar_model_from_json(JsonReader& reader) {
  ExemplarModel model;
  model.axes.clear();
  reader.read("raw_values", model.raw_values);
  reader.read("squares", model.squares);
  reader.read("mean", model.mean);
  for (JsonReader& channel : reader.objects("channels")) {
    Vec<3> axis(1.0);
    model.channels.push_back(spectrum_from_json(channel, axis));
    model.axes.push_back(axis);
  }
  reader.finish();
  reader.validate(model);
  return model;
}

Json JsonForm<ExemplarModel>::write(const ExemplarModel& model) {
  return to_json(model);
}

void JsonForm<ExemplarModel>::read(JsonReader& reader, const std::string& key, ExemplarModel& model) {
  if (auto object = reader.object(key)) model = exemplar_model_from_json(*object);
}

Json JsonForm<ExemplarModel>::schema() {
  return {{"type", "object"}};
}

Json exemplar_file_to_json(const ExemplarModel& model) {
  Json json = recipe_header();
  json["exemplar"] = to_json(model);
  return json;
}

ExemplarModel exemplar_file_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  auto exemplar = reader.object("exemplar");
  if (!exemplar) throw std::invalid_argument("exemplar is missing; it must be the model of an exemplar");
  const ExemplarModel model = exemplar_model_from_json(*exemplar);
  double of_file = 0.0;  // ExemplarFile's
  reader.read("pixel_size", of_file);
  reader.finish();
  return model;
}

}  // namespace solidnoise
