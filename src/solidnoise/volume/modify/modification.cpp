#include "solidnoise/volume/modify/modification.h"

#include "solidnoise/core/check.h"

namespace solidnoise {

void Modification::validate() const {
  require_finite("amount", amount);
  if (combine == Combine::erode) require_at_least("amount", amount, 0.0, "to erode");
  if (displace) require_finite("displace", *displace);
}

}  // namespace solidnoise
