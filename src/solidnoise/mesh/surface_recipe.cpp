#include "solidnoise/mesh/surface_recipe.h"

#include "solidnoise/core/check.h"
#include "solidnoise/noise/gabor/surface_gabor_options.h"

namespace solidnoise {

void SurfaceNoiseRecipe::validate() const {
  fractal.validate();
  SurfaceGaborOptions{.error = error, .impulses = impulses, .layer = layer}.validate();
}

bool may_vary(SurfaceNoiseKind kind) {
  return kind != SurfaceNoiseKind::kensler && kind != SurfaceNoiseKind::kensler_solid;
}

bool is_gabor(SurfaceNoiseKind kind) {
  return may_vary(kind);
}

}  // namespace solidnoise
