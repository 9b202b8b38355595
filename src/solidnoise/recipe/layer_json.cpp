#include "solidnoise/recipe/layer_json.h"

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {

Json JsonForm<std::vector<Layer>>::write(const std::vector<Layer>& layers) {
  Json json = Json::array();
  for (const Layer& layer : layers) json.push_back(json_of(layer));
  return json;
}

void JsonForm<std::vector<Layer>>::read(JsonReader& reader, const std::string& key,
                                        std::vector<Layer>& layers) {
  for (JsonReader& object : reader.objects(key)) {
    read_fields(object, layers.emplace_back());
    object.finish();
  }
}

Json JsonForm<std::vector<Layer>>::schema() {
  return {{"type", "array"}, {"items", {{"$ref", "#/$defs/layer"}}}, {"minItems", 1}};
}

void add_layers(Json& object, const std::vector<Layer>& layers) {
  if (!layers.empty()) object["layers"] = json_of(layers);
}

void read_layers(JsonReader& reader, std::vector<Layer>& layers) {
  read_value(reader, "layers", layers);
}

}  // namespace solidnoise
