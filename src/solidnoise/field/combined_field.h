#pragma once

#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/field/layer.h"

namespace solidnoise {

// The values of several fields become one, in their order; see Layer::Combine. A mix is of three. Throws
// std::invalid_argument if there are none, or their channels differ.
FieldPtr combine(Layer::Combine how, std::vector<FieldPtr> fields);

// The channels of several fields, one field after the other.
FieldPtr side_by_side(std::vector<FieldPtr> fields);

}  // namespace solidnoise
