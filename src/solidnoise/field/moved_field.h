#pragma once

#include <array>

#include "solidnoise/core/field.h"

namespace solidnoise {

// The field looked up at p / stretch, so that what is in it is so much longer along each axis; itself where
// all of them are 1. `stretch` > 0.
FieldPtr stretched(FieldPtr field, const Vec<3>& stretch);

// The field looked up at displaced positions, p + amount (w0(p), w1(p), w2(p)). `amount` in world units.
FieldPtr warp(FieldPtr field, double amount, const std::array<FieldPtr, 3>& shifts);

}  // namespace solidnoise
