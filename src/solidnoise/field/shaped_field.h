#pragma once

#include <span>

#include "solidnoise/core/box.h"
#include "solidnoise/core/field.h"
#include "solidnoise/field/shaping.h"

namespace solidnoise {

// Maps values of a noise of unit variance to the range.
void to_range(RawShaping::Range range, std::span<float> values);

// What a shaping makes of a field that stands in the place of a noise of unit variance.

// The field in another range; RawShaping::Range::raw is the field itself.
FieldPtr shape(FieldPtr source, const RawShaping& shaping);

// The field is clamped to +-6, so that what is certainly empty is known. `box` in world units is where `edge`
// is measured.
FieldPtr shape(FieldPtr source, const RemapShaping& shaping, const Box<3>& box);

FieldPtr shape(FieldPtr source, const VeinShaping& shaping);

}  // namespace solidnoise
