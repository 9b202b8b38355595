#include "solidnoise/noise/gradient/gradient_noise_options.h"

#include "solidnoise/noise/gradient/gradient_fields.h"

namespace solidnoise {

void GradientNoiseOptions::validate() const {
  require_fields(*this);
}

}  // namespace solidnoise
