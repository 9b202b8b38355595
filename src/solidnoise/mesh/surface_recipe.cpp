#include "solidnoise/mesh/surface_recipe.h"

#include "solidnoise/core/random.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"

namespace solidnoise {

void SurfaceNoiseRecipe::validate() const {
  require_fields(*this);
  if (kind == SurfaceNoiseKind::spectrum)
    SpectrumNoiseOptions{.model = exemplar, .channel = channel}.validate();
}

bool may_vary(SurfaceNoiseKind kind) {
  return has_bandwidth(kind);
}

bool is_gabor(SurfaceNoiseKind kind) {
  return has_bandwidth(kind) || kind == SurfaceNoiseKind::spectrum;
}

bool has_bandwidth(SurfaceNoiseKind kind) {
  return kind == SurfaceNoiseKind::surface || kind == SurfaceNoiseKind::oriented ||
         kind == SurfaceNoiseKind::solid;
}

bool has_layer(const SurfaceNoiseRecipe& recipe) {
  return recipe.kind == SurfaceNoiseKind::surface || has_direction(recipe);
}

bool has_direction(const SurfaceNoiseRecipe& recipe) {
  if (recipe.kind != SurfaceNoiseKind::spectrum) return recipe.kind == SurfaceNoiseKind::oriented;
  return !recipe.exemplar.channels.empty() && recipe.exemplar.channels.front().dimensions == 2;
}

SurfaceNoiseRecipe channel_of(const SurfaceNoiseRecipe& recipe, int channel) {
  SurfaceNoiseRecipe other = recipe;
  other.channel = channel;
  if (channel > 0) {
    other.seed = derive_seed(recipe.seed, kChannelStream + static_cast<std::uint64_t>(channel));
  }
  return other;
}

}  // namespace solidnoise
