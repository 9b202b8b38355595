#include "solidnoise/volume/layer_json.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {
namespace {

Json pairs_to_json(const std::vector<Vec<2>>& pairs) {
  Json json = Json::array();
  for (const Vec<2>& pair : pairs) json.push_back({pair.x, pair.y});
  return json;
}

Json layer_to_json(const Layer& layer) {
  Json json = Json::object();
  if (layer.layers.empty()) {
    if (layer.noise) json["noise"] = to_json(*layer.noise);
    json["fold"] = name_of(kLayerFoldChoices, layer.fold);
    json["histogram"] = name_of(kHistogramChoices, layer.histogram);
  } else {
    json["combine"] = name_of(kLayerCombineChoices, layer.combine);
    add_layers(json, layer.layers);
  }
  if (!layer.ramp.empty()) json["ramp"] = pairs_to_json(layer.ramp);
  json["weight"] = layer.weight;
  json["bias"] = layer.bias;
  if (layer.warp) {
    json["warp"]["amount"] = layer.warp->amount;
    if (layer.warp->noise) json["warp"]["noise"] = to_json(*layer.warp->noise);
  }
  return json;
}

void read_noise(JsonReader& reader, std::optional<NoiseRecipe>& noise) {
  if (auto object = reader.object("noise")) noise = noise_recipe_from_json(*object);
}

void read_layers_at(JsonReader& reader, std::vector<Layer>& layers, int depth);

Layer layer_from_json(JsonReader& reader, int depth) {
  Layer layer;
  read_noise(reader, layer.noise);
  reader.read("fold", kLayerFoldChoices, layer.fold);
  reader.read("histogram", kHistogramChoices, layer.histogram);
  reader.read("combine", kLayerCombineChoices, layer.combine);
  read_layers_at(reader, layer.layers, depth + 1);
  reader.read("ramp", layer.ramp);
  reader.read("weight", layer.weight);
  reader.read("bias", layer.bias);
  if (auto warp = reader.object("warp")) {
    layer.warp.emplace();
    warp->read("amount", layer.warp->amount);
    read_noise(*warp, layer.warp->noise);
    warp->finish();
  }
  reader.finish();
  return layer;
}

void read_layers_at(JsonReader& reader, std::vector<Layer>& layers, int depth) {
  if (!reader.has("layers") || depth <= kDeepestLayer) {
    for (JsonReader& object : reader.objects("layers")) layers.push_back(layer_from_json(object, depth));
    return;
  }
  throw std::invalid_argument(fmt::format("{} is at level {}; layers can be {} deep",
                                          reader.path_of("layers"), depth, kDeepestLayer));
}

}  // namespace

void add_layers(Json& object, const std::vector<Layer>& layers) {
  for (const Layer& layer : layers) object["layers"].push_back(layer_to_json(layer));
}

void read_layers(JsonReader& reader, std::vector<Layer>& layers) {
  read_layers_at(reader, layers, 1);
}

}  // namespace solidnoise
