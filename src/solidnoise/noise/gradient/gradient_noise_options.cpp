#include "solidnoise/noise/gradient/gradient_noise_options.h"

#include "solidnoise/noise/gradient/gradient_entry.h"

namespace solidnoise {

void GradientNoiseOptions::validate() const {
  require_fields(*this);
}

}  // namespace solidnoise
