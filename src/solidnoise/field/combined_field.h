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

// All channels of a field times a mask of one channel, clamped to 0..1. The field is evaluated where the mask
// is not 0. Throws std::invalid_argument if the mask has several channels.
FieldPtr masked(FieldPtr field, FieldPtr mask);

}  // namespace solidnoise
