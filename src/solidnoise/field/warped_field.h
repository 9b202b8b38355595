#pragma once

#include <array>

#include "solidnoise/core/field.h"

namespace solidnoise {

// The field looked up at displaced positions, p + amount (w0(p), w1(p), w2(p)). `amount` in world units.
FieldPtr warp(FieldPtr field, double amount, const std::array<FieldPtr, 3>& shifts);

}  // namespace solidnoise
