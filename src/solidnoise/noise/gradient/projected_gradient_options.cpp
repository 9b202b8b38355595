#include "solidnoise/noise/gradient/projected_gradient_options.h"

#include "solidnoise/core/check.h"

namespace solidnoise {

void ProjectedGradientOptions::validate() const {
  require_positive("frequency", frequency, "cycles per world unit");
}

}  // namespace solidnoise
