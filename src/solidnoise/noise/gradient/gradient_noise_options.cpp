#include "solidnoise/noise/gradient/gradient_noise_options.h"

#include "solidnoise/core/check.h"

namespace solidnoise {

void GradientNoiseOptions::validate() const {
  require_positive("frequency", frequency, "cycles per world unit");
  for (int axis = 0; axis < 4; ++axis) {
    require_at_least("period", period[axis], 0.0, "world units; 0 for none");
  }
}

}  // namespace solidnoise
