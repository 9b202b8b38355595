#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "solidnoise/core/points.h"

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

}  // namespace solidnoise
