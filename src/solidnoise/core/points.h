#pragma once

#include <array>
#include <cstddef>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// A batch of scattered positions: point i is at origin[axis] + offset[axis][i], in world units. The origin is
// in double precision and the offsets are small floats, so that positions far from the world's origin stay
// exact. The batch does not own the offsets.
template <int Dim>
struct Points {
  Vec<Dim> origin{0.0};
  std::array<const float*, Dim> offset{};
  std::size_t count = 0;

  double coordinate(std::size_t point, int axis) const {
    return origin[axis] + static_cast<double>(offset[axis][point]);
  }
};

}  // namespace solidnoise
