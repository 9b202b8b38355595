#include "solidnoise/mesh/bake_recipe_json.h"

#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/recipe_header.h"

namespace solidnoise {
namespace {

Json range_to_json(const ParameterRange& range) {
  if (!range.varies()) return range.from;
  return {range.from, range.to};
}

void read_range(JsonReader& reader, const std::string& key, ParameterRange& range) {
  reader.read_range(key, range.from, range.to);
}

Json surface_to_json(const SurfaceNoiseRecipe& recipe) {
  Json json = Json::object();
  json["noise"] = name_of(kSurfaceNoiseChoices, recipe.kind);
  if (recipe.kind == SurfaceNoiseKind::spectrum) {
    json["exemplar"] = to_json(recipe.exemplar);
    json["channel"] = recipe.channel;
  }
  json["error"] = recipe.error;
  json["impulses"] = recipe.impulses;
  json["layer"] = recipe.layer;
  json["seed"] = recipe.seed;
  json["octaves"] = recipe.fractal.octaves;
  json["lacunarity"] = recipe.fractal.lacunarity;
  json["gain"] = recipe.fractal.gain;
  json["renormalize"] = recipe.fractal.renormalize;
  return json;
}

void read_surface(JsonReader& reader, SurfaceNoiseRecipe& recipe) {
  reader.read("noise", kSurfaceNoiseChoices, recipe.kind);
  if (auto exemplar = reader.object("exemplar")) recipe.exemplar = exemplar_model_from_json(*exemplar);
  reader.read("channel", recipe.channel);
  reader.read("error", recipe.error);
  reader.read("impulses", recipe.impulses);
  reader.read("layer", recipe.layer);
  reader.read("seed", recipe.seed);
  reader.read("octaves", recipe.fractal.octaves);
  reader.read("lacunarity", recipe.fractal.lacunarity);
  reader.read("gain", recipe.fractal.gain);
  reader.read("renormalize", recipe.fractal.renormalize);
  reader.finish();
  reader.validate(recipe);
}

Json steering_to_json(const Steering& steering) {
  Json json = Json::object();
  if (steering.source == SteeringSource::attribute) {
    json["attribute"] = steering.attribute;
  } else {
    json["source"] = name_of(kSteeringChoices, steering.source);
  }
  json["percentiles"] = {steering.low_percentile, steering.high_percentile};
  json["gamma"] = steering.gamma;
  return json;
}

void read_steering(JsonReader& reader, Steering& steering) {
  if (reader.has("source") && reader.has("attribute")) {
    throw std::invalid_argument(reader.path_of("source") +
                                " and attribute contradict each other; give one of them");
  }
  reader.read("source", kSteeringChoices, steering.source);
  reader.read("attribute", steering.attribute);
  if (reader.has("attribute")) steering.source = SteeringSource::attribute;
  reader.read_range("percentiles", steering.low_percentile, steering.high_percentile);
  reader.read("gamma", steering.gamma);
  reader.finish();
  reader.validate(steering);
}

}  // namespace

Json to_json(const BakeRecipe& recipe) {
  Json json = recipe_header();
  if (!recipe.description.empty()) json["description"] = recipe.description;
  json["surface"] = surface_to_json(recipe.noise);
  if (recipe.frequency) {
    json["frequency"] = range_to_json(*recipe.frequency);
  } else {
    json["detail"] = range_to_json(recipe.detail);
  }
  json["bandwidth"] = range_to_json(recipe.bandwidth);
  json["magnitude"] = range_to_json(recipe.magnitude);
  json["bias"] = range_to_json(recipe.bias);
  json["by"] = steering_to_json(recipe.by);
  json["smooth"] = recipe.smooth;
  json["smooth_radius"] = recipe.smooth_radius;
  const Vec<3>& axis = recipe.direction.axis;
  json["direction"] = {{"source", name_of(kDirectionChoices, recipe.direction.source)},
                       {"axis", {axis.x, axis.y, axis.z}},
                       {"smooth", recipe.direction.smooth}};
  json["ramp"] = recipe.ramp;
  json["contrast"] = recipe.contrast;
  json["refine"] = {{"mode", name_of(kRefineChoices, recipe.refine.mode)},
                    {"rounds", recipe.refine.rounds},
                    {"method", name_of(kRefineMethodChoices, recipe.refine.method)},
                    {"placement", name_of(kPlacementChoices, recipe.refine.placement)}};
  json["displace"] = recipe.displace;
  json["up"] = name_of(kUpAxisChoices, recipe.up);
  return json;
}

BakeRecipe bake_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  BakeRecipe recipe;
  reader.read("description", recipe.description);
  if (auto surface = reader.object("surface")) read_surface(*surface, recipe.noise);
  ParameterRange frequency;
  read_range(reader, "frequency", frequency);
  if (reader.has("frequency")) recipe.frequency = frequency;
  read_range(reader, "detail", recipe.detail);
  read_range(reader, "bandwidth", recipe.bandwidth);
  read_range(reader, "magnitude", recipe.magnitude);
  read_range(reader, "bias", recipe.bias);
  if (auto by = reader.object("by")) read_steering(*by, recipe.by);
  reader.read("smooth", recipe.smooth);
  reader.read("smooth_radius", recipe.smooth_radius);
  if (auto direction = reader.object("direction")) {
    direction->read("source", kDirectionChoices, recipe.direction.source);
    direction->read("axis", recipe.direction.axis);
    direction->read("smooth", recipe.direction.smooth);
    direction->finish();
  }
  reader.read("ramp", recipe.ramp);
  reader.read("contrast", recipe.contrast);
  if (auto refine = reader.object("refine")) {
    refine->read("mode", kRefineChoices, recipe.refine.mode);
    refine->read("rounds", recipe.refine.rounds);
    refine->read("method", kRefineMethodChoices, recipe.refine.method);
    refine->read("placement", kPlacementChoices, recipe.refine.placement);
    refine->finish();
  }
  reader.read("displace", recipe.displace);
  reader.read("up", kUpAxisChoices, recipe.up);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

}  // namespace solidnoise
