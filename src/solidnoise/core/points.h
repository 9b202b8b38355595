#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Scattered positions, in world units and double precision, so that noise is as smooth far from the world's
// origin as near it. Owns nothing.
template <int Dim>
struct Points {
  std::span<const Vec<Dim>> positions;

  // Of points of a surface, else empty: its normals there, smooth (interpolated) and of any length but 0; and
  // which vertices of its mesh they are, for fields that have a number for each vertex.
  std::span<const Vec<Dim>> normals{};
  std::span<const std::uint32_t> vertices{};

  std::size_t size() const { return positions.size(); }
  double coordinate(std::size_t point, int axis) const { return positions[point][axis]; }
};

}  // namespace solidnoise
