#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// The field looked up at p / stretch, so that what is in it is so much longer along each axis; itself where
// all of them are 1. `stretch` > 0.
FieldPtr stretched(FieldPtr field, const Vec<3>& stretch);

}  // namespace solidnoise
