#include "solidnoise/volume/derived_volume.h"

#include <utility>
#include <vector>

#include "solidnoise/volume/field/curl_field.h"
#include "solidnoise/volume/field/derived_fields.h"

namespace solidnoise {
namespace {

using SharedNoise = std::shared_ptr<const Noise<3>>;

SharedNoise channel_noise(const VolumeRecipe& recipe, int channel) {
  VolumeRecipe other = recipe;
  other.noise = channel_of(recipe.noise, channel);
  return make_volume_noise(other);
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
    options.potentials[static_cast<std::size_t>(c)] = channel_noise(recipe, c);
  }
  options.speed = recipe.speed;
  VolumeRecipe whole = recipe;
  whole.noise = unfiltered(recipe.noise);
  options.mean_square = curl_mean_square(*make_volume_noise(whole));
  options.boundary = plan.boundary_distance;
  return make_curl_field(options);
}

// Null where the noise is not by an example in colour, or its values are to be of another range than its own.
std::unique_ptr<Field> make_colors_by_example(const VolumeRecipe& recipe) {
  const auto* const spectrum = std::get_if<SpectrumNoiseOptions>(&recipe.noise.noise);
  const bool own_range = std::get<RawShaping>(recipe.shaping).range == RawShaping::Range::raw;
  if (!spectrum || spectrum->model.channels.size() < 3 || !own_range) return nullptr;
  return make_exemplar_colors({channel_noise(recipe, 0), channel_noise(recipe, 1), channel_noise(recipe, 2)},
                              spectrum->model);
}

}  // namespace

std::unique_ptr<Field> make_derived_field(const VolumeRecipe& recipe, const VolumePlan& plan) {
  switch (recipe.output.front()) {
    case Output::curl:
      return make_velocity(recipe, plan);
    case Output::color:
      if (auto colors = make_colors_by_example(recipe)) return colors;
      return make_channels_field(
          {channel_noise(recipe, 0), channel_noise(recipe, 1), channel_noise(recipe, 2)},
          std::get<RawShaping>(recipe.shaping));
    case Output::phase:
    case Output::intensity:
      return make_phasor_field(make_volume_noise(recipe), make_volume_quadrature(recipe), recipe.output);
    case Output::value:
    case Output::gradient:
      break;
  }
  return make_gradient_field(make_volume_noise(recipe), recipe.output);
}

}  // namespace solidnoise
