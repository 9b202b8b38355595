#include "solidnoise/mesh/bake_recipe_json.h"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {

// One number where it does not vary.
template <>
struct JsonForm<ParameterRange> {
  static Json write(const ParameterRange& range) {
    if (!range.varies()) return range.from;
    return {range.from, range.to};
  }
  static void read(JsonReader& reader, const std::string& key, ParameterRange& range) {
    reader.read_range(key, range.from, range.to);
  }
  static Json schema(const Interval& allowed) {
    return {{"oneOf", {number_schema(allowed), numbers_schema(allowed, 2)}}};
  }
};

template <>
struct JsonForm<Steering> {
  static Json write(const Steering& steering) {
    Json json = Json::object();
    write_fields(steering, json);
    return json;
  }
  static void read(JsonReader& reader, const std::string& key, Steering& steering) {
    auto object = reader.object(key);
    if (!object) return;
    object->refuse_both("source", "attribute");
    read_fields(*object, steering);
    if (object->has("attribute")) steering.source = SteeringSource::attribute;
    object->finish();
    object->validate(steering);
  }
  static Json schema() {
    Json schema = schema_of<Steering>();
    schema["not"]["required"] = {"source", "attribute"};
    return schema;
  }
};

Json to_json(const BakeRecipe& recipe) {
  Json json = recipe_header();
  write_fields(recipe, json);
  return json;
}

BakeRecipe bake_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  BakeRecipe recipe;
  read_fields(reader, recipe);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

Json bake_recipe_schema() {
  Json schema = file_schema("Noise on a mesh, for meshnoise", schema_of<BakeRecipe>());
  schema["$defs"] = {{"noise", noise_recipe_schema()}, {"layer", schema_of<Layer>()}};
  return schema;
}

namespace {

Json describe_number(const VertexNumber& number) {
  if (!number.varies()) return number.constant;
  const auto [least, most] = std::minmax_element(number.values.begin(), number.values.end());
  return {{"least", *least}, {"most", *most}};
}

Json describe_kernel(const SurfaceNoiseRecipe& recipe, const VertexParameters& parameters) {
  SurfaceGaborOptions options;
  options.frequency = parameters.frequency.constant;
  options.bandwidth = parameters.bandwidth.constant;
  options.error = recipe.error;
  options.impulses = recipe.impulses;
  options.impulses_process = recipe.impulses_process;
  options.kurtosis = recipe.kurtosis;
  options.layer = recipe.layer;
  if (recipe.kind == SurfaceNoiseKind::oriented) options.waves = GaborWaves::oriented;
  const SurfaceGaborNoise noise(with_truncation_share(options));
  const bool varies = parameters.frequency.varies() || parameters.bandwidth.varies();
  return {
      {"frequency", options.frequency},
      {"radius", noise.radius()},
      {"impulses_per_kernel", varies ? noise.varying_impulses_per_kernel() : noise.impulses_per_kernel()},
      {"excess_kurtosis", varies ? noise.varying_excess_kurtosis() : noise.excess_kurtosis()},
      {"kurtosis_given_place", varies ? noise.varying_kurtosis_given_place() : noise.kurtosis_given_place()}};
}

Json describe_steering(const SteeringWeights& steering) {
  return {{"least", steering.least},
          {"low", steering.low},
          {"high", steering.high},
          {"most", steering.most},
          {"histogram", steering.histogram}};
}

}  // namespace

Json describe_bake(const BakePlan& plan, const BakeRecipe& recipe) {
  Json json = Json::object();
  json["mesh"] = {{"vertices", plan.mesh.positions.size()},
                  {"faces", plan.mesh.face_count()},
                  {"new_vertices", plan.mesh.positions.size() - plan.original_vertices},
                  {"mean_edge", plan.mean_edge}};
  json["noise"] = {{"type", name_of(kSurfaceNoiseChoices, recipe.noise.kind)},
                   {"frequency", describe_number(plan.parameters.frequency)},
                   {"bandwidth", describe_number(plan.parameters.bandwidth)},
                   {"magnitude", describe_number(plan.parameters.magnitude)},
                   {"bias", describe_number(plan.parameters.bias)},
                   {"highest_frequency", plan.highest_frequency},
                   {"mean_cycles_per_edge", plan.mean_cycles_per_edge},
                   {"vertices_to_show", plan.vertices_to_show}};
  if (recipe.noise.kind == SurfaceNoiseKind::surface || recipe.noise.kind == SurfaceNoiseKind::oriented)
    json["noise"]["kernel"] = describe_kernel(recipe.noise, plan.parameters);
  if (!plan.guides.numbers.empty()) json["steering"] = describe_steering(plan.guides.steering);
  const Cost cost = bake_cost(plan, recipe);
  json["cost"] = {{"seconds_of_one_core", cost.seconds}, {"memory_bytes", cost.bytes}};
  json["recipe"] = to_json(recipe);
  return json;
}

}  // namespace solidnoise
