#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// A field that several others are made of: blocks that a thread makes for one box are one block, which keeps
// what it has evaluated last, so that all of them pay for it once. Values are the field's.
FieldPtr share(FieldPtr field);

}  // namespace solidnoise
