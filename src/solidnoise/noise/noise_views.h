#pragma once

#include <memory>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise moved by `offset`, world units: its value at x is that of `noise` at x - offset. Statistics and
// spectrum are the noise's. Throws std::invalid_argument for an offset that is not finite.
template <int Dim>
std::unique_ptr<Noise<Dim>> move_noise(std::shared_ptr<const Noise<Dim>> noise, const Vec<Dim>& offset);

// A frame of a 4D noise, at time t, as a 3D noise. Its spectrum is that of the 4D noise integrated over the
// temporal frequency; it is not that of the 3D noise with the same parameters.
std::unique_ptr<Noise<3>> slice(std::shared_ptr<const Noise<4>> noise, double t);

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
