#include "solidnoise/noise/gabor/varying_gabor_options.h"

#include "solidnoise/core/check.h"

namespace solidnoise {

void VaryingGaborOptions::validate() const {
  require_positive("frequency", frequency, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_in_range("impulses", impulses, 0.0, 100000.0, "mean impulses per kernel; 0 chooses");
  for (int axis = 0; axis < 4; ++axis) require_finite("direction", direction[axis]);
}

}  // namespace solidnoise
