#include "solidnoise/mesh/tangent_frames.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace solidnoise {

std::complex<double> TangentFrame::in_frame(const Vec<3>& tangent) const {
  return {glm::dot(tangent, first), glm::dot(tangent, second)};
}

// Duff et al. 2017, "Building an orthonormal basis, revisited": no branch and no loss of digits.
TangentFrame make_frame(const Vec<3>& normal) {
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  return {{1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
          {b, sign + normal.y * normal.y * a, -normal.y},
          normal};
}

std::vector<TangentFrame> make_frames(const std::vector<Vec<3>>& normals) {
  std::vector<TangentFrame> frames(normals.size());
  tbb::parallel_for(std::size_t{0}, normals.size(),
                    [&](std::size_t i) { frames[i] = make_frame(normals[i]); });
  return frames;
}

std::complex<double> transport(const TangentFrame& from, const TangentFrame& to) {
  // The rotation takes u, perpendicular to m, to u - (u.n) (m + n) / (1 + m.n). For opposite normals there is
  // no smallest one, and no frame is better than another.
  constexpr double kOpposite = 1e-9;
  const double cosine = 1.0 + glm::dot(from.normal, to.normal);
  if (cosine < kOpposite) return 1.0;
  const Vec<3> rotated = from.first - glm::dot(from.first, to.normal) / cosine * (from.normal + to.normal);
  const std::complex<double> result = to.in_frame(rotated);
  return result / std::abs(result);
}

std::complex<double> direction_of_line(std::complex<double> line) {
  return std::polar(1.0, 0.5 * std::arg(line));
}

}  // namespace solidnoise
