#include "solidnoise/noise/gabor/surface_gabor_options.h"

#include <stdexcept>

#include "solidnoise/core/check.h"

namespace solidnoise {

void SurfaceGaborOptions::validate() const {
  require_positive("frequency", frequency, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_in_range("impulses", impulses, 0.0, 100000.0, "mean impulses per kernel; 0 chooses");
  require_in_range("layer", layer, 0.1, 1.0, "kernel radii");
  for (int axis = 0; axis < 3; ++axis) require_finite("direction", direction[axis]);
  if (direction == Vec<3>(0.0)) throw std::invalid_argument("direction is 0; it must have a length");
}

}  // namespace solidnoise
