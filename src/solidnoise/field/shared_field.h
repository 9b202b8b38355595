#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// A field that several others are made of, which pay for it once: blocks that a thread makes for one box are
// one block, which keeps what it has evaluated last; a thread's last points are kept, too. Values are the
// field's.
FieldPtr share(FieldPtr field);

}  // namespace solidnoise
