#include "solidnoise/volume/volume_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "solidnoise/field/cloud_field.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/curl_field.h"
#include "solidnoise/field/derived_fields.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/shaped_field.h"
#include "solidnoise/field/varying_field.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/moved_noise.h"
#include "solidnoise/noise/slice_noise.h"

namespace solidnoise {
namespace {

using NoisePtr = std::shared_ptr<const Noise<3>>;

// The noise that `make(dimensions, noise recipe)` makes, as it is in the volume: at its time and place.
template <typename Make>
std::shared_ptr<const Noise<3>> make_framed(const VolumeRecipe& recipe, const Make& make) {
  std::shared_ptr<const Noise<3>> noise;
  if (recipe.dims == 3) {
    noise = make(std::integral_constant<int, 3>(), at_time(recipe.noise, recipe.time));
  } else {
    noise = slice(make(std::integral_constant<int, 4>(), recipe.noise), recipe.time);
  }
  return recipe.offset == Vec<3>(0.0) ? noise : move_noise<3>(noise, recipe.offset);
}

// What is left of the recipe's error interpolates the noise, where that is quicker.
std::shared_ptr<const Noise<3>> on_voxels(const VolumeRecipe& recipe, std::shared_ptr<const Noise<3>> noise,
                                          const GridFrame& frame) {
  if (recipe.exact) return noise;
  const bool slopes = std::all_of(recipe.output.begin(), recipe.output.end(), [](Output output) {
    return output == Output::gradient || output == Output::curl;
  });
  return interpolate<3>(std::move(noise), voxel_lattice(recipe, frame),
                        ErrorBudget(error_of(recipe.noise)).interpolation,
                        slopes ? Quantity::gradient : Quantity::values);
}

NoisePtr make_noise_of(VolumeRecipe recipe, const NoiseRecipe& noise) {
  recipe.noise = noise;
  return make_volume_noise(recipe);
}

// The noise in the place of the recipe's, on the plan's voxels.
NoisePtr make_voxel_noise(const VolumeRecipe& recipe, const VolumePlan& plan, const NoiseRecipe& noise) {
  return on_voxels(recipe, make_noise_of(recipe, noise), plan.frame);
}

NoisePtr make_voxel_quadrature(const VolumeRecipe& recipe, const VolumePlan& plan) {
  const auto noise = make_framed(
      recipe, [](auto dim, const NoiseRecipe& of) { return make_quadrature<decltype(dim)::value>(of); });
  return on_voxels(recipe, noise, plan.frame);
}

NoiseView view_of(const VolumeRecipe& recipe) {
  return {recipe.dims, recipe.time, recipe.offset};
}

FieldPtr with_magnitude(FieldPtr field, const VolumePlan& plan) {
  const bool varies = plan.parameters && plan.parameters->magnitude();
  return varies ? combine(Layer::Combine::product, {std::move(field), plan.parameters->magnitude()}) : field;
}

// Octave k of a recipe's noise by itself.
FieldPtr make_octave(const VolumeRecipe& recipe, const VolumePlan& plan, int k) {
  const FieldPtr octave =
      recipe.parameters.vary_kernel()
          ? make_varying_octave(recipe.noise, k, view_of(recipe), plan.parameters->kernel())
          : make_voxel_noise(recipe, plan, octave_of(recipe.noise, k));
  return with_magnitude(octave, plan);
}

FieldPtr make_cloud(const VolumeRecipe& recipe, const VolumePlan& plan, const CloudShaping& shaping) {
  CloudParts parts;
  parts.shaping = shaping;
  parts.wavelength =
      1.0 / std::visit([](const auto& options) { return options.frequency; }, recipe.noise.noise);
  parts.box = plan.box;
  parts.up = recipe.up;
  parts.seed = seed_of(recipe.noise);
  for (int k = 0; k < recipe.noise.fractal.octaves; ++k) {
    parts.octaves.push_back({make_octave(recipe, plan, k), std::pow(recipe.noise.fractal.gain, k)});
  }
  return make_cloud_field(parts);
}

FieldPtr shaped(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (const auto* const cloud = std::get_if<CloudShaping>(&recipe.shaping)) {
    return make_cloud(recipe, plan, *cloud);
  }
  const FieldPtr source = make_volume_source(recipe, plan);
  if (const auto* const remap = std::get_if<RemapShaping>(&recipe.shaping)) {
    return shape(source, *remap, plan.box);
  }
  if (const auto* const veins = std::get_if<VeinShaping>(&recipe.shaping)) return shape(source, *veins);
  return shape(source, std::get<RawShaping>(recipe.shaping));
}

NoiseRecipe unfiltered(const NoiseRecipe& recipe) {
  NoiseRecipe result = recipe;
  const auto clear = [](auto& options) {
    if constexpr (requires { options.filter; }) options.filter = 0.0;
  };
  std::visit(clear, result.noise);
  return result;
}

FieldPtr make_velocity(const VolumeRecipe& recipe, const VolumePlan& plan) {
  CurlOptions options;
  for (int c = 0; c < 3; ++c) {
    options.potentials[static_cast<std::size_t>(c)] =
        make_voxel_noise(recipe, plan, channel_of(recipe.noise, c));
  }
  options.speed = recipe.speed;
  options.mean_square = curl_mean_square(*make_noise_of(recipe, unfiltered(recipe.noise)));
  options.boundary = plan.boundary_distance;
  return make_curl_field(options);
}

FieldPtr make_colors(const VolumeRecipe& recipe, const VolumePlan& plan) {
  std::vector<FieldPtr> channels;
  for (int c = 0; c < 3; ++c) channels.push_back(make_voxel_noise(recipe, plan, channel_of(recipe.noise, c)));
  if (const ExemplarModel* const exemplar = exemplar_of_colors(recipe)) {
    return exemplar_colors_of(channels, *exemplar);
  }
  for (FieldPtr& channel : channels) channel = shape(channel, std::get<RawShaping>(recipe.shaping));
  return side_by_side(channels);
}

}  // namespace

std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe) {
  if (recipe.band_limit) throw std::invalid_argument("band_limit needs the size of the voxels");
  return make_framed(
      recipe, [](auto dim, const NoiseRecipe& noise) { return make_noise<decltype(dim)::value>(noise); });
}

LatticeFrame<3> voxel_lattice(const VolumeRecipe& recipe, const GridFrame& frame) {
  LatticeFrame<3> lattice{frame.origin(), frame.voxel_size()};
  const Vec<4> period = std::visit([](const auto& options) { return options.period; }, recipe.noise.noise);
  for (int axis = 0; axis < 3; ++axis) lattice.period[axis] = whole_period(period[axis], lattice.step[axis]);
  return lattice;
}

FieldPtr make_volume_source(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (!recipe.layers.empty()) {
    return make_layered_field(recipe.layers, recipe.noise, [&](const NoiseRecipe& noise) -> FieldPtr {
      return make_voxel_noise(recipe, plan, noise);
    });
  }
  const FieldPtr noise = recipe.parameters.vary_kernel()
                             ? make_varying_field(recipe.noise, view_of(recipe), plan.parameters->kernel())
                             : make_voxel_noise(recipe, plan, recipe.noise);
  return with_magnitude(noise, plan);
}

FieldPtr make_volume_field(const VolumeRecipe& recipe, const VolumePlan& plan) {
  switch (recipe.output.front()) {
    case Output::curl:
      return make_velocity(recipe, plan);
    case Output::color:
      return make_colors(recipe, plan);
    case Output::phase:
    case Output::intensity:
      return phasor_of(make_voxel_noise(recipe, plan, recipe.noise), make_voxel_quadrature(recipe, plan));
    case Output::value:
    case Output::gradient:
      break;
  }
  if (is_scalar(recipe)) return shaped(recipe, plan);
  const NoisePtr noise = make_voxel_noise(recipe, plan, recipe.noise);
  return recipe.output.size() == 1 ? gradient_of(noise) : value_and_gradient_of(noise);
}

std::vector<GridChannels> channels_of(const VolumeRecipe& recipe) {
  const bool raw = std::holds_alternative<RawShaping>(recipe.shaping);
  std::vector<GridChannels> grids;
  for (const Output output : recipe.output) {
    const bool second =
        output == Output::intensity || (output == Output::gradient && recipe.output.size() > 1);
    grids.push_back({second ? 1 : 0, components_of(output), raw ? Sparsity::keep : Sparsity::drop});
  }
  return grids;
}

FieldPtr make_raw_field(const VolumeRecipe& recipe) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (!raw) throw std::invalid_argument("a field without voxels is of raw noise");
  const auto make = [&](const NoiseRecipe& noise) -> FieldPtr { return make_noise_of(recipe, noise); };
  return shape(
      recipe.layers.empty() ? make(recipe.noise) : make_layered_field(recipe.layers, recipe.noise, make),
      *raw);
}

double highest_frequency(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (recipe.layers.empty()) {
    if (!recipe.parameters.vary_kernel()) return make_volume_noise(recipe)->band().upper;
    return make_varying_field(recipe.noise, view_of(recipe), plan.parameters->kernel())
        ->statistics()
        ->band.upper;
  }
  double highest = 0.0;
  for (const NoiseRecipe& noise : noises_of(recipe.layers, recipe.noise)) {
    highest = std::max(highest, make_noise_of(recipe, noise)->band().upper);
  }
  return highest;
}

}  // namespace solidnoise
