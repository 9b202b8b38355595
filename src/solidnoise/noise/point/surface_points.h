#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Points on surfaces, with the surface's normals: any length but 0, either sign, one float per point and
// axis. They should be smooth (interpolated) normals: noises on surfaces are continuous in the normal, and
// have seams where that has.
struct SurfacePoints {
  Points<3> positions;
  std::array<std::span<const float>, 3> normal;

  // Throws std::invalid_argument naming the first point whose position is not finite or whose normal has no
  // direction.
  void validate() const;
};

// A direction laid into the tangent plane of a unit normal, of unit length; some tangent where it is along
// the normal, as far as single precision tells.
Vec<3> unit_tangent(const Vec<3>& direction, const Vec<3>& normal);

}  // namespace solidnoise
