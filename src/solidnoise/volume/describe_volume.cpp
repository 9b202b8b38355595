#include "solidnoise/volume/describe_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/volume_field.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// The kernel of the first octave; the others have theirs, smaller by the lacunarity.
void describe_kernel(const NoiseRecipe& recipe, int dims, Json& json) {
  const auto of_kernel = [&](const char* key, const auto& value) { json["kernel"][key] = value; };
  const auto of_noise = [&](const char* key, const auto& value) { json[key] = value; };
  const auto describe = [&]<typename Options>(const Options& whole) {
    using Entry = NoiseEntry<Options>;
    const Options options = with_truncation_share(whole);
    dims == 3 ? Entry::template describe<3>(options, of_kernel, of_noise)
              : Entry::template describe<4>(options, of_kernel, of_noise);
  };
  std::visit(describe, recipe.noise);
}

// Rates in turns per unit of time, the half-life of the correlation in units of time.
void describe_evolution(const NoiseRecipe& recipe, Json& json) {
  for (int k = 0; k < recipe.fractal.octaves; ++k) {
    const NoiseRecipe octave = octave_of(recipe, k);
    const Evolution& evolution = *evolution_of(octave);
    json["octave_rates"].push_back(evolution.rate);
    json["octave_half_lives"].push_back(evolution_half_life(evolution));
  }
}

// Least and greatest of the grids' active voxels.
void describe_parameters(const ParameterFields& parameters, Json& json) {
  const KernelFields kernel = parameters.kernel();
  if (const auto& frequency = kernel.frequency) json["frequency"] = {frequency.least, frequency.greatest};
  if (const auto& bandwidth = kernel.bandwidth) json["bandwidth"] = {bandwidth.least, bandwidth.greatest};
  if (const auto& field = parameters.magnitude()) json["magnitude"] = {field->least(), field->greatest()};
}

void describe_statistics(const Field<3>& field, double largest_voxel, Json& json) {
  const Statistics statistics = *field.statistics();
  const Band& band = statistics.band;
  json["variance"] = statistics.variance;
  json["excess_kurtosis"] = statistics.excess_kurtosis;
  json["band_cycles_per_unit"] = {band.lower, band.upper};
  json["band_cycles_per_voxel"] = {band.lower * largest_voxel, band.upper * largest_voxel};
}

// How each octave, or band of a noise by example, is evaluated: at every so many voxels along each axis, the
// others interpolated from so many samples; or directly.
Json describe_plans(const std::vector<InterpolationPlan<3>>& plans) {
  Json parts = Json::array();
  for (const auto& plan : plans) {
    Json evaluated = Json::object();
    for (const AxisStep& axis : plan.axes) {
      if (plan.direct()) continue;
      evaluated["step_voxels"].push_back(axis.step);
      evaluated["taps"].push_back(axis.taps);
    }
    parts.push_back(plan.direct() ? Json("direct") : evaluated);
  }
  return parts;
}

// Predicted root mean square errors relative to the noise's standard deviation, and to that of its gradient
// where there is one in the volume. Not of noises without an error.
void describe_error(const VolumeRecipe& recipe, const Noise<3>& noise, const GridFrame& frame, Json& json) {
  if (error_of(recipe.noise) == 0.0 || noise.variance() == 0.0) return;
  const double allowed = recipe.exact ? 0.0 : ErrorBudget(error_of(recipe.noise)).interpolation;
  const InterpolationPlanner<3> planner(noise, voxel_lattice(recipe, frame));
  const auto plans = planner.plan(allowed);
  double truncation = 0.0;
  double interpolation = 0.0;
  for (const auto& part : plans) {
    truncation += part.error.truncation / noise.variance();
    interpolation += part.error.interpolation / noise.variance();
  }
  json["error"]["truncation"] = std::sqrt(truncation);
  json["error"]["interpolation"] = std::sqrt(interpolation);
  json["error"]["total"] = std::sqrt(truncation + interpolation);
  json["evaluation"] = describe_plans(plans);
  if (!has_gradient(recipe)) return;
  const auto of_gradient = planner.plan(allowed, Quantity::gradient);
  const Vec<3> power = noise.gradient_variance();
  double error = 0.0;
  for (const auto& part : of_gradient) error += part.error.interpolation / (power.x + power.y + power.z);
  json["error"]["gradient_interpolation"] = std::sqrt(error);
  json["gradient_evaluation"] = describe_plans(of_gradient);
}

// A noise whose kernels vary from place to place.
Json describe_varying(const VolumeRecipe& recipe, const VolumePlan& plan, double largest_voxel) {
  Json json = Json::object();
  json["type"] = noise_type(recipe.noise);
  json["dims"] = recipe.dims;
  json["octaves"] = recipe.noise.fractal.octaves;
  describe_parameters(*plan.parameters, json["from_grids"]);
  describe_statistics(*make_varying_volume_noise(recipe, plan), largest_voxel, json);
  return json;
}

Json describe_noise(const VolumeRecipe& recipe, const VolumePlan& plan, double largest_voxel) {
  if (recipe.parameters.vary_kernel()) return describe_varying(recipe, plan, largest_voxel);
  Json json = Json::object();
  json["type"] = noise_type(recipe.noise);
  json["dims"] = recipe.dims;
  VolumeRecipe made = recipe;
  made.noise = noise_of_output(recipe, recipe.noise);
  describe_kernel(made.noise, made.dims, json);
  json["octaves"] = recipe.noise.fractal.octaves;

  if (evolves(recipe.noise)) describe_evolution(recipe.noise, json["evolution"]);

  if (plan.parameters) describe_parameters(*plan.parameters, json["from_grids"]);
  const auto noise = make_volume_noise(made);
  describe_statistics(*noise, largest_voxel, json);
  describe_error(recipe, *noise, plan.frame, json);
  return json;
}

Json describe_grid(const VolumePlan& plan) {
  const openvdb::Coord size = plan.voxels.dim();
  const Vec<3>& voxel = plan.frame.voxel_size();
  Json json = Json::object();
  json["voxel_size"] = {voxel.x, voxel.y, voxel.z};
  json["dim"] = {size.x(), size.y(), size.z()};
  json["voxels_at_most"] = static_cast<std::uint64_t>(size.x()) * static_cast<std::uint64_t>(size.y()) *
                           static_cast<std::uint64_t>(size.z());
  json["memory_at_most_bytes"] = plan.memory;
  return json;
}

// The grids that would be in the file, in their order.
Json describe_outputs(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (plan.modification) {
    return Json::array({{{"name", plan.modification->grid().getName()}, {"components", 1}}});
  }
  Json json = Json::array();
  for (const OutputGrid& grid : output_grids(recipe)) {
    json.push_back({{"name", grid.name}, {"components", components_of(grid.output)}});
  }
  return json;
}

}  // namespace

Json describe_volume(const VolumeRecipe& recipe, const DescribeOptions& options) {
  const VolumePlan plan = plan_volume(recipe, options.part, options.progress);
  const Vec<3>& voxel = plan.frame.voxel_size();
  const double largest = std::max({voxel.x, voxel.y, voxel.z});
  Json json = Json::object();
  json["noise"] = describe_noise(at_resolution(recipe, voxel), plan, largest);
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    if (single.layers.empty() && recipe.grids.empty()) continue;
    for (const NoiseRecipe& noise : noises_of(single)) {
      VolumeRecipe layer = at_resolution(single, voxel);
      layer.noise = noise;
      layer.layers.clear();
      json["layer_noises"].push_back(describe_noise(layer, plan, largest));
    }
  }
  json["grid"] = describe_grid(plan);
  const int threads = max_threads();
  const auto [making, cost] = plan_making(recipe, plan, threads, options.memory, options.target);
  json["cost"] = {{"seconds_of_one_core", cost.seconds},
                  {"threads", threads},
                  {"memory_bytes", cost.bytes},
                  {"streamed", making == Making::streamed}};
  json["grids"] = describe_outputs(recipe, plan);
  json["recipe"] = to_json(recipe);
  return json;
}

}  // namespace solidnoise
