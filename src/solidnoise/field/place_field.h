#pragma once

#include "solidnoise/core/box.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/up_axis.h"
#include "solidnoise/field/layer.h"

namespace solidnoise {

// Where a sample is in a box; see Layer::Place, which must not be none.
FieldPtr place_in(const Box<3>& box, UpAxis up, Layer::Place place);

}  // namespace solidnoise
