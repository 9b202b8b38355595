#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <span>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// A right-handed frame of a surface's tangent plane.
struct TangentFrame {
  Vec<3> first;
  Vec<3> second;
  Vec<3> normal;

  // A tangent vector as a complex number, and back.
  std::complex<double> in_frame(const Vec<3>& tangent) const;
  Vec<3> in_space(std::complex<double> tangent) const {
    return tangent.real() * first + tangent.imag() * second;
  }
};

// An arbitrary frame, the same for equal normals. `normal` is of length 1. Duff et al. 2017, "Building an
// orthonormal basis, revisited": no branch and no loss of digits.
inline TangentFrame make_frame(const Vec<3>& normal) {
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  return {{1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
          {b, sign + normal.y * normal.y * a, -normal.y},
          normal};
}

// The frames of many normals, each made when it is asked for: that is quicker than reading it.
class TangentFrames {
 public:
  // Keeps a reference to the normals.
  explicit TangentFrames(std::span<const Vec<3>> normals) : normals_(normals) {}

  std::size_t size() const { return normals_.size(); }
  TangentFrame operator[](std::size_t i) const { return make_frame(normals_[i]); }

 private:
  std::span<const Vec<3>> normals_;
};

// What a tangent vector at `from` is to be multiplied with to become one at `to`, carried by the smallest
// rotation that takes one normal to the other (on a fine mesh, parallel transport). Of length 1.
std::complex<double> transport(const TangentFrame& from, const TangentFrame& to);

// A line (a direction without a sign) at the angle p in its frame is the complex number e^(2ip): both signs
// give the same. So is the part without trace of a symmetric tensor,
//   [ a  b ]
//   [ b -a ]  as a + ib:  its positive eigenvalue is |a + ib|, with eigenvectors at the angle arg(a + ib)
//   / 2.
inline std::complex<double> line_at(std::complex<double> tangent) {
  return tangent * tangent;
}
// One of the two directions; the first axis for 0.
std::complex<double> direction_of_line(std::complex<double> line);

// The mean of lines that vectors of either sign give in space: each is turned to the side of the sum of those
// before it, which then is no shorter. Its length is the mean of theirs.
class LineMean {
 public:
  void add(const Vec<3>& line, double weight);
  Vec<3> line() const;  // 0 of none

 private:
  Vec<3> sum_{0.0};
  double length_ = 0.0;
  double weight_ = 0.0;
};

// How a surface bends at a point: the derivative of its unit normal along the surface, a symmetric tensor.
// Its eigenvalues are the principal curvatures, positive where the surface bends away from its normal, as a
// sphere does from the outside. In a tangent frame it is
//   [ mean + a      b     ]
//   [     b      mean - a ],   line = a + ib (see tangent_frames.h).
struct ShapeOperator {
  double mean = 0.0;                // H, 1/world unit
  std::complex<double> line = 0.0;  // 1/world unit
};

}  // namespace solidnoise
