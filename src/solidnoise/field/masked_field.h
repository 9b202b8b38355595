#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// All channels of a field times a mask of one channel, clamped to 0..1. The field is evaluated where the mask
// is not 0. Throws std::invalid_argument if the mask has several channels.
FieldPtr masked(FieldPtr field, FieldPtr mask);

}  // namespace solidnoise
