#include "meshnoise/describe.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"

namespace solidnoise {
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
  options.layer = recipe.layer;
  if (recipe.kind == SurfaceNoiseKind::oriented) options.waves = GaborWaves::oriented;
  const SurfaceGaborNoise noise(options);
  return {{"frequency", options.frequency},
          {"radius", noise.radius()},
          {"impulses_per_kernel", noise.impulses_per_kernel()},
          {"excess_kurtosis", noise.excess_kurtosis()}};
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
                   {"mean_cycles_per_edge", plan.mean_cycles_per_edge}};
  if (recipe.noise.kind == SurfaceNoiseKind::surface || recipe.noise.kind == SurfaceNoiseKind::oriented)
    json["noise"]["kernel"] = describe_kernel(recipe.noise, plan.parameters);
  if (!plan.guides.numbers.empty()) json["steering"] = describe_steering(plan.guides.steering);
  json["recipe"] = to_json(recipe);
  return json;
}

}  // namespace solidnoise
