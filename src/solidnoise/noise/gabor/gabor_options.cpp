#include "solidnoise/noise/gabor/gabor_options.h"

#include <stdexcept>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// What both kinds of Gabor noise ask for.
template <typename Options>
void validate_common(const Options& options) {
  require_positive("frequency", options.frequency, "cycles per world unit");
  require_in_range("bandwidth", options.bandwidth, 0.05, 4.0, "octaves");
  require_in_range("error", options.error, 1e-4, 0.5, "relative RMS error");
  require_in_range("impulses", options.impulses, 0.0, 100000.0, "mean impulses per kernel; 0 chooses");
  for (int axis = 0; axis < 4; ++axis) {
    require_at_least("period", options.period[axis], 0.0, "world units; 0 for none");
  }
  options.evolution.validate();
  require_at_least("filter", options.filter, 0.0, "world units; 0 for none");
}

}  // namespace

void GaborNoiseOptions::validate() const {
  validate_common(*this);
}

void OrientedGaborNoiseOptions::validate() const {
  validate_common(*this);
  require_in_range("anisotropy", anisotropy, 0.0, 1.0);
  double squared_length = 0.0;
  for (int axis = 0; axis < 4; ++axis) {
    require_finite("direction", direction[axis]);
    squared_length += direction[axis] * direction[axis];
  }
  if (squared_length == 0.0) throw std::invalid_argument("direction is 0; it must have a length");
}

}  // namespace solidnoise
