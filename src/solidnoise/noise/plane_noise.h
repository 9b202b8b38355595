#pragma once

#include <memory>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A plane in space: its point (x, y) is origin + x right + y up, world units.
struct Plane {
  Vec<3> origin{0.0};
  Vec<3> right{1.0, 0.0, 0.0};  // unit vectors, perpendicular
  Vec<3> up{0.0, 1.0, 0.0};
};

// A 3D noise on a plane, as a 2D noise. Its spectrum is that of the 3D noise integrated over the frequency
// across the plane (the projection-slice theorem).
std::unique_ptr<Noise<2>> on_plane(std::shared_ptr<const Noise<3>> noise, const Plane& plane);

}  // namespace solidnoise
