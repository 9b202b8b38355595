#pragma once

#include <memory>
#include <span>

#include "solidnoise/mesh/surface_recipe.h"
#include "solidnoise/noise/gabor/varying_parameters.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/point/surface_points.h"

namespace solidnoise {

// One octave of a noise on a surface, of unit variance. Immutable; may be shared between
// threads.
class SurfaceOctave {
 public:
  virtual ~SurfaceOctave() = default;

  // Gradient noises take no parameters but the options' (may_vary()).
  virtual void evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                        std::span<float> values) const = 0;

  virtual Noise<2>::Band band() const = 0;
};

// `frequency` and `bandwidth` hold where they do not vary. Throws std::invalid_argument.
std::unique_ptr<SurfaceOctave> make_surface_octave(const SurfaceNoiseRecipe& recipe, double frequency,
                                                   double bandwidth, std::uint64_t seed);

}  // namespace solidnoise
