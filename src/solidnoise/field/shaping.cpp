#include "solidnoise/field/shaping.h"

#include <stdexcept>

#include "solidnoise/field/field_tables.h"

namespace solidnoise {

void RawShaping::validate() const {}

void RemapShaping::validate() const {
  require_fields(*this);
}

void VeinShaping::validate() const {
  require_fields(*this);
  if (direction == Vec<3>(0.0)) {
    throw std::invalid_argument("direction is 0 0 0; it must have a length");
  }
}

void CloudShaping::validate() const {
  require_fields(*this);
}

}  // namespace solidnoise
