#include "solidnoise/field/shaping.h"

#include <stdexcept>

#include "solidnoise/core/check.h"

namespace solidnoise {

void RawShaping::validate() const {}

void RemapShaping::validate() const {
  require_finite("threshold", threshold);
  require_positive("softness", softness, "sigmas");
  require_positive("power", power);
  require_at_least("edge", edge, 0.0, "sigmas");
  require_in_range("floor", floor, 0.0, 1.0);
}

void VeinShaping::validate() const {
  for (int axis = 0; axis < 3; ++axis) require_finite("direction", direction[axis]);
  if (direction == Vec<3>(0.0)) {
    throw std::invalid_argument("direction is 0 0 0; it must have a length");
  }
  require_positive("spacing", spacing, "world units");
  require_at_least("turbulence", turbulence, 0.0, "spacings");
  require_positive("sharpness", sharpness);
  require_in_range("floor", floor, 0.0, 1.0);
}

void CloudShaping::validate() const {
  require_in_range("puffs", puffs, 1, 1000);
  require_in_range("lobes", lobes, 0.0, 2.0, "wavelengths");
  require_in_range("base", base, 0.0, 1.0);
  require_positive("edge", edge, "wavelengths");
  require_in_range("wisps", wisps, 0.0, 4.0, "edge widths");
  require_in_range("core", core, 0.0, 1.0);
  require_in_range("lean", lean, 0.0, 2.0);
}

}  // namespace solidnoise
