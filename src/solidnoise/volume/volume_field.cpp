#include "solidnoise/volume/volume_field.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "solidnoise/field/cloud_field.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/curl_field.h"
#include "solidnoise/field/derived_fields.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/field/shared_field.h"
#include "solidnoise/field/varying_field.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"

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
  const Vec<3> by = moved(recipe);
  return by == Vec<3>(0.0) ? noise : move_noise<3>(noise, by);
}

// Where voxels look a noise up: at their positions over `stretch`, or where warps move these.
struct LookUp {
  Vec<3> stretch{1.0};
  std::optional<PointSpread> warped{};
};

// What is left of the recipe's error interpolates the noise, where that is quicker.
NoisePtr on_voxels(const VolumeRecipe& recipe, NoisePtr noise, const GridFrame& frame,
                   const LookUp& look_up = {}) {
  if (recipe.exact) return noise;
  const bool slopes = std::all_of(recipe.output.begin(), recipe.output.end(), [](Output output) {
    return output == Output::gradient || output == Output::curl;
  });
  LatticeFrame<3> lattice = voxel_lattice(recipe, frame);
  if (look_up.stretch != Vec<3>(1.0)) {
    lattice = {lattice.origin / look_up.stretch, lattice.step / look_up.stretch};
  }
  const double error = ErrorBudget(error_of(recipe.noise)).interpolation;
  if (look_up.warped) return interpolate_at_points(std::move(noise), lattice, error, *look_up.warped);
  return interpolate<3>(std::move(noise), lattice, error, slopes ? Quantity::gradient : Quantity::values);
}

NoisePtr make_noise_of(VolumeRecipe recipe, const NoiseRecipe& noise) {
  recipe.noise = noise;
  return make_volume_noise(recipe);
}

// The noise in the place of the recipe's, on the plan's voxels.
NoisePtr make_voxel_noise(const VolumeRecipe& recipe, const VolumePlan& plan, const NoiseRecipe& noise) {
  return on_voxels(recipe, make_noise_of(recipe, noise_of_output(recipe, noise)), plan.frame);
}

NoiseView view_of(const VolumeRecipe& recipe) {
  return {recipe.dims, recipe.time, moved(recipe)};
}

LayerNoise varying_layer_noise(const VolumeRecipe& recipe, const VolumePlan& plan) {
  const KernelFields kernel = plan.parameters->kernel();
  const NoiseView view = view_of(recipe);
  const auto make = [=](const NoiseRecipe& noise) { return make_varying_field(noise, view, kernel); };
  LayerNoise made = layer_noise(recipe.noise, make);
  made.octave = [=, noise = recipe.noise](int k) { return make_varying_octave(noise, k, view, kernel); };
  made.varying_frequency = kernel.frequency.field;
  return made;
}

// Layers of a recipe as they are on the plan's voxels. Named fields are made once.
class VolumeLayers {
 public:
  VolumeLayers(const VolumeRecipe& recipe, const VolumePlan& plan) : recipe_(recipe), plan_(plan) {}

  // `own` is the noise of layers that name none, which varies where the recipe's does.
  FieldPtr make(const std::vector<Layer>& layers, const NoiseRecipe& own) {
    const bool varies = recipe_.parameters.vary_kernel() && own == recipe_.noise;
    LayerLeaves leaves;
    leaves.noise = [&, varies](const NoiseUse& use) {
      if (!use.noise && varies) return varying_layer_noise(recipe_, plan_);
      return layer_noise(noise_of_layer(use.noise, own),
                         [this, stretch = use.stretch, warp = use.warp](const NoiseRecipe& recipe) {
                           return make_leaf(recipe, stretch, warp);
                         });
    };
    leaves.named = [&](const std::string& name) { return named(name); };
    leaves.place = [&](Layer::Place place) { return place_in(plan_.box, recipe_.up, place); };
    return make_layered_field(layers, leaves);
  }

 private:
  FieldPtr make_leaf(const NoiseRecipe& recipe, const Vec<3>& stretch, double warp) const {
    LookUp look_up{stretch};
    if (warp > 0.0) {
      look_up.warped = spread_by_warp(plan_, warp);
      look_up.warped->reach /= stretch;
    }
    VolumeRecipe layer = recipe_;
    layer.noise = recipe;
    layer.wind /= stretch;  // which moves what is stretched
    const NoisePtr noise = make_noise_of(layer, recipe);
    return stretched(on_voxels(layer, noise, plan_.frame, look_up), stretch);
  }

  FieldPtr named(const std::string& name) {
    if (const auto known = named_.find(name); known != named_.end()) return known->second;
    return named_[name] =
               share(make({recipe_.fields.at(name)}, recipe_.noise_of_fields.value_or(recipe_.noise)));
  }

  const VolumeRecipe& recipe_;
  const VolumePlan& plan_;
  std::map<std::string, FieldPtr> named_;
};

NoisePtr make_voxel_quadrature(const VolumeRecipe& recipe, const VolumePlan& plan) {
  const auto noise = make_framed(
      recipe, [](auto dim, const NoiseRecipe& of) { return make_quadrature<decltype(dim)::value>(of); });
  return on_voxels(recipe, noise, plan.frame);
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
  parts.voxel = plan.frame.voxel_size();
  for (int k = 0; k < recipe.noise.fractal.octaves; ++k) {
    parts.octaves.push_back({make_octave(recipe, plan, k), recipe.noise.fractal.amplitude_ratio(k)});
  }
  return make_cloud_field(parts);
}

// What is shaped: the noise, or the layers in its place.
FieldPtr make_source(const VolumeRecipe& recipe, const VolumePlan& plan, VolumeLayers& layers) {
  const FieldPtr noise = !recipe.layers.empty()            ? layers.make(recipe.layers, recipe.noise)
                         : recipe.parameters.vary_kernel() ? make_varying_volume_noise(recipe, plan)
                                                           : make_voxel_noise(recipe, plan, recipe.noise);
  return with_magnitude(noise, plan);
}

// Raw noise of a recipe, normalized in a box where the recipe says so.
FieldPtr normalized(const VolumeRecipe& recipe, const Box<3>& box, FieldPtr noise) {
  const Normalization normalization = normalization_of(recipe, box);
  return normalization.changes_nothing() ? noise : map_field(std::move(noise), normalization);
}

FieldPtr shaped(const VolumeRecipe& recipe, const VolumePlan& plan, VolumeLayers& layers) {
  if (const auto* const cloud = std::get_if<CloudShaping>(&recipe.shaping)) {
    return make_cloud(recipe, plan, *cloud);
  }
  const FieldPtr source = make_source(recipe, plan, layers);
  if (const auto* const remap = std::get_if<RemapShaping>(&recipe.shaping)) {
    return shape(source, *remap, plan.box);
  }
  if (const auto* const veins = std::get_if<VeinShaping>(&recipe.shaping)) return shape(source, *veins);
  return shape(normalized(recipe, plan.box, source), std::get<RawShaping>(recipe.shaping));
}

NoiseRecipe unfiltered(const NoiseRecipe& recipe) {
  NoiseRecipe result = recipe;
  const auto clear = [](auto& options) {
    if constexpr (requires { options.filter; }) options.filter = 0.0;
  };
  std::visit(clear, result.noise);
  return result;
}

FieldPtr make_velocity(const VolumeRecipe& recipe, const VolumePlan& plan,
                       std::shared_ptr<const SmoothDistance> boundary) {
  CurlOptions options;
  for (int c = 0; c < 3; ++c) {
    options.potentials[static_cast<std::size_t>(c)] =
        make_voxel_noise(recipe, plan, channel_of(recipe.noise, c));
  }
  options.speed = recipe.speed;
  options.mean_square =
      curl_mean_square(*make_noise_of(recipe, noise_of_output(recipe, unfiltered(recipe.noise))));
  options.drift = recipe.drift;
  options.boundary = std::move(boundary);
  return make_curl_field(options);
}

FieldPtr make_colors(const VolumeRecipe& recipe, const VolumePlan& plan) {
  std::vector<FieldPtr> channels;
  for (int c = 0; c < 3; ++c) {
    VolumeRecipe single = recipe;
    single.noise = channel_of(recipe.noise, c);
    channels.push_back(normalized(single, plan.box, make_voxel_noise(single, plan, single.noise)));
  }
  if (const ExemplarModel* const exemplar = exemplar_of_colors(recipe)) {
    return exemplar_colors_of(channels, *exemplar);
  }
  for (FieldPtr& channel : channels) channel = shape(channel, std::get<RawShaping>(recipe.shaping));
  return side_by_side(channels);
}

// The field of a short form, its outputs' channels in the order of Output.
FieldPtr make_grid_field(const VolumeRecipe& recipe, const VolumePlan& plan,
                         std::shared_ptr<const SmoothDistance> boundary, VolumeLayers& layers) {
  switch (recipe.output.front()) {
    case Output::curl:
      return make_velocity(recipe, plan, std::move(boundary));
    case Output::color:
      return make_colors(recipe, plan);
    case Output::phase:
    case Output::intensity:
      return phasor_of(make_voxel_noise(recipe, plan, recipe.noise), make_voxel_quadrature(recipe, plan));
    case Output::value:
    case Output::gradient:
      break;
  }
  if (is_scalar(recipe)) return shaped(recipe, plan, layers);
  const NoisePtr noise = make_voxel_noise(recipe, plan, recipe.noise);
  return recipe.output.size() == 1 ? gradient_of(noise) : value_and_gradient_of(noise);
}

// Which of them each output is.
std::vector<GridChannels> channels_of(const VolumeRecipe& recipe) {
  const Sparsity sparsity = keeps_all_voxels(recipe) ? Sparsity::keep : Sparsity::drop;
  std::vector<GridChannels> grids;
  for (const Output output : recipe.output) {
    const bool second =
        output == Output::intensity || (output == Output::gradient && recipe.output.size() > 1);
    grids.push_back({second ? 1 : 0, components_of(output), sparsity});
  }
  return grids;
}

}  // namespace

std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe) {
  if (recipe.band_limit) throw std::invalid_argument("band_limit needs the size of the voxels");
  return make_framed(
      recipe, [](auto dim, const NoiseRecipe& noise) { return make_noise<decltype(dim)::value>(noise); });
}

PointSpread spread_by_warp(const VolumePlan& plan, double amount) {
  constexpr double kFarthest = 3.0;  // in standard deviations
  PointSpread spread{Vec<3>(kFarthest * amount), 1.0};
  const Vec<3> size = plan.box.upper - plan.box.lower;
  for (int axis = 0; axis < 3; ++axis) spread.volume *= 1.0 + 2.0 * spread.reach[axis] / size[axis];
  return spread;
}

LatticeFrame<3> voxel_lattice(const VolumeRecipe& recipe, const GridFrame& frame) {
  LatticeFrame<3> lattice{frame.origin(), frame.voxel_size()};
  const Vec<4> period = period_of(recipe.noise);
  for (int axis = 0; axis < 3; ++axis) lattice.period[axis] = whole_period(period[axis], lattice.step[axis]);
  return lattice;
}

FieldPtr make_varying_volume_noise(const VolumeRecipe& recipe, const VolumePlan& plan) {
  return make_varying_field(recipe.noise, view_of(recipe), plan.parameters->kernel());
}

bool keeps_all_voxels(const VolumeRecipe& recipe) {
  return std::holds_alternative<RawShaping>(recipe.shaping) && !recipe.sparse && !recipe.within;
}

VolumeField make_volume_field(const VolumeRecipe& recipe, const VolumePlan& plan, FieldPtr cover) {
  VolumeLayers layers(recipe, plan);
  const std::vector<VolumeRecipe> singles = recipes_of_grids(recipe);
  VolumeField volume;
  std::vector<FieldPtr> fields;
  int first = 0;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const VolumeRecipe single = at_resolution(singles[i], plan.frame.voxel_size());
    const bool has_boundary = i < plan.boundaries.size() && plan.boundaries[i].distance;
    fields.push_back(make_grid_field(
        single, plan, has_boundary ? plan.boundaries[i].distance->distance() : nullptr, layers));
    if (single.within) fields.back() = masked(fields.back(), layers.make({*single.within}, single.noise));
    if (cover && !std::holds_alternative<RawShaping>(single.shaping)) {
      fields.back() = masked(fields.back(), cover);
    }
    for (GridChannels grid : channels_of(single)) {
      grid.first += first;
      volume.grids.push_back(grid);
    }
    first += fields.back()->channels();
  }
  volume.field = fields.size() == 1 ? fields.front() : side_by_side(fields);
  return volume;
}

Normalization normalization_of(const VolumeRecipe& recipe, const Box<3>& box) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (!raw || !raw->normalize) return {};
  return normalization_in<3>(*make_volume_noise(recipe), box, period_of(recipe.noise));
}

double highest_frequency(const VolumeRecipe& recipe, const VolumePlan& plan) {
  double highest = 0.0;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    if (single.parameters.vary_kernel()) {
      highest = std::max(highest, make_varying_volume_noise(single, plan)->statistics()->band.upper);
      if (single.layers.empty()) continue;
    }
    for (const NoiseRecipe& noise : noises_of(single)) {
      highest = std::max(highest, make_noise_of(single, noise)->band().upper);
    }
  }
  return highest;
}

}  // namespace solidnoise
