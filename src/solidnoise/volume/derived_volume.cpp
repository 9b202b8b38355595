#include "solidnoise/volume/derived_volume.h"

#include <utility>
#include <vector>

#include "solidnoise/volume/field/curl_field.h"
#include "solidnoise/volume/field/derived_fields.h"

namespace solidnoise {
namespace {

using SharedNoise = std::shared_ptr<const Noise<3>>;

SharedNoise channel_noise(const VolumeRecipe& recipe, const GridFrame& frame, int channel) {
  VolumeRecipe other = recipe;
  other.noise = channel_of(recipe.noise, channel);
  return make_voxel_noise(other, frame);
}

NoiseRecipe unfiltered(const NoiseRecipe& recipe) {
  NoiseRecipe result = recipe;
  const auto clear = [](auto& options) {
    if constexpr (requires { options.filter; }) options.filter = 0.0;
  };
  std::visit(clear, result.noise);
  return result;
}

std::unique_ptr<Field> make_velocity(const VolumeRecipe& recipe, const VolumePlan& plan) {
  CurlOptions options;
  for (int c = 0; c < 3; ++c) {
    options.potentials[static_cast<std::size_t>(c)] = channel_noise(recipe, plan.frame, c);
  }
  options.speed = recipe.speed;
  VolumeRecipe whole = recipe;
  whole.noise = unfiltered(recipe.noise);
  options.mean_square = curl_mean_square(*make_volume_noise(whole));
  options.boundary = plan.boundary_distance;
  return make_curl_field(options);
}

std::unique_ptr<Field> make_colors(const VolumeRecipe& recipe, const GridFrame& frame) {
  std::vector<SharedNoise> channels;
  for (int c = 0; c < 3; ++c) channels.push_back(channel_noise(recipe, frame, c));
  if (const ExemplarModel* const exemplar = exemplar_of_colors(recipe)) {
    return make_exemplar_colors(channels, *exemplar);
  }
  return make_channels_field(channels, std::get<RawShaping>(recipe.shaping));
}

}  // namespace

std::unique_ptr<Field> make_derived_field(const VolumeRecipe& recipe, const VolumePlan& plan) {
  switch (recipe.output.front()) {
    case Output::curl:
      return make_velocity(recipe, plan);
    case Output::color:
      return make_colors(recipe, plan.frame);
    case Output::phase:
    case Output::intensity:
      return make_phasor_field(make_voxel_noise(recipe, plan.frame),
                               make_voxel_quadrature(recipe, plan.frame), recipe.output);
    case Output::value:
    case Output::gradient:
      break;
  }
  return make_gradient_field(make_voxel_noise(recipe, plan.frame), recipe.output);
}

}  // namespace solidnoise
