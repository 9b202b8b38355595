#include "vdbnoise/describe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/volume_field.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// Lengths in world units, frequencies in cycles per world unit, the density in impulses per world unit^Dim,
// the filter as the standard deviation of a Gaussian.
template <typename Noise>
void describe_impulses(const Noise& noise, Json& json) {
  json["impulses_per_kernel"] = noise.impulses_per_kernel();
  json["impulse_density"] = noise.impulse_density();
  json["filter"] = noise.options().filter;
}

template <int Dim>
void describe_kernel(const GaborNoiseOptions& options, Json& json) {
  const GaborNoise<Dim> noise(options);
  json["kernel"]["kind"] = "isotropic Gabor";
  json["kernel"]["frequency"] = noise.kernel().frequency();
  json["kernel"]["a"] = noise.kernel().a();
  json["kernel"]["radius"] = noise.radius();
  json["kernel"]["degree"] = noise.compact_kernel().degree();
  json["kernel"]["relative_error"] = noise.compact_kernel().relative_error();
  describe_impulses(noise, json);
}

template <int Dim>
void describe_kernel(const OrientedGaborNoiseOptions& options, Json& json) {
  const OrientedGaborNoise<Dim> noise(options);
  json["kernel"]["kind"] = "oriented Gabor, random phase";
  json["kernel"]["frequency"] = noise.frequency();
  json["kernel"]["a"] = noise.kernel().a();
  json["kernel"]["radius"] = noise.radius();
  json["kernel"]["half_width"] = noise.envelope().radius();
  json["kernel"]["degree"] = noise.envelope().degree();
  json["kernel"]["relative_error"] = noise.options().error;
  describe_impulses(noise, json);
}

template <int Dim>
void describe_kernel(const GradientNoiseOptions& options, Json& json) {
  const GradientNoise<Dim> noise(options);
  constexpr double kRadiusInSpacings = 2.0;
  const Vec<Dim>& spacing = noise.lattice_spacing();
  json["kernel"]["kind"] = "radial gradient";
  json["kernel"]["frequency"] = noise.options().frequency;
  json["kernel"]["radius"] = kRadiusInSpacings * spacing[0];
  for (int axis = 0; axis < Dim; ++axis) json["lattice_spacing"].push_back(spacing[axis]);
}

// A noise by example has 3 dimensions.
template <int Dim>
void describe_kernel(const SpectrumNoiseOptions& options, Json& json) {
  const SpectrumNoise<3> noise(options);
  json["kernel"]["kind"] = "oriented Gabor by example, random phase";
  json["kernel"]["bands"] = noise.spectrum().bands.size();
  std::size_t components = 0;
  for (const SpectrumBand& band : noise.spectrum().bands) components += band.components.size();
  json["kernel"]["components"] = components;
  json["kernel"]["frequency"] = options.frequency;
  json["kernel"]["relative_error"] = options.error;
  json["impulses_per_kernel"] = noise.impulses_per_kernel();
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

bool wants_gradient(const VolumeRecipe& recipe) {
  return std::any_of(recipe.output.begin(), recipe.output.end(),
                     [](Output output) { return output == Output::gradient || output == Output::curl; });
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
  if (!wants_gradient(recipe)) return;
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
  describe_statistics(*make_volume_source(recipe, plan), largest_voxel, json);
  return json;
}

// The kernel is that of the first octave; the others have theirs, smaller by the lacunarity.
Json describe_noise(const VolumeRecipe& recipe, const VolumePlan& plan, double largest_voxel) {
  if (recipe.parameters.vary_kernel()) return describe_varying(recipe, plan, largest_voxel);
  Json json = Json::object();
  json["type"] = noise_type(recipe.noise);
  json["dims"] = recipe.dims;
  const auto by_type = [&](const auto& whole) {
    const auto options = with_truncation_share(whole);
    recipe.dims == 3 ? describe_kernel<3>(options, json) : describe_kernel<4>(options, json);
  };
  std::visit(by_type, recipe.noise.noise);
  json["octaves"] = recipe.noise.fractal.octaves;

  if (evolves(recipe.noise)) describe_evolution(recipe.noise, json["evolution"]);

  if (plan.parameters) describe_parameters(*plan.parameters, json["from_grids"]);
  const auto noise = make_volume_noise(recipe);
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
Json describe_outputs(const VolumeRecipe& recipe) {
  const std::vector<std::string> names = grid_names(recipe);
  Json json = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    Json grid = Json::object();
    grid["name"] = names[i];
    grid["components"] = components_of(recipe.output[i]);
    json.push_back(grid);
  }
  return json;
}

}  // namespace

Json describe_volume(const VolumeRecipe& recipe) {
  const VolumePlan plan = plan_volume(recipe);
  const Vec<3>& voxel = plan.frame.voxel_size();
  Json json = Json::object();
  json["noise"] = describe_noise(at_resolution(recipe, voxel), plan, std::max({voxel.x, voxel.y, voxel.z}));
  for (const NoiseRecipe& noise : noises_of(recipe.layers, recipe.noise)) {
    VolumeRecipe layer = at_resolution(recipe, voxel);
    layer.noise = noise;
    layer.layers.clear();
    json["layer_noises"].push_back(describe_noise(layer, plan, std::max({voxel.x, voxel.y, voxel.z})));
  }
  json["grid"] = describe_grid(plan);
  json["grids"] = describe_outputs(recipe);
  json["recipe"] = to_json(recipe);
  return json;
}

}  // namespace solidnoise
