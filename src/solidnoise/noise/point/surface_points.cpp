#include "solidnoise/noise/point/surface_points.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/noise/gabor/varying_parameters.h"

namespace solidnoise {
namespace {

// Some unit vector at a right angle to a unit vector.
Vec<3> any_tangent(const Vec<3>& normal) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) < std::abs(normal[least])) least = axis;
  }
  Vec<3> axis(0.0);
  axis[least] = 1.0;
  return glm::normalize(glm::cross(normal, axis));
}

}  // namespace

void SurfacePoints::validate() const {
  require_finite_positions(positions);
  for (const auto& component : normal) {
    if (component.size() != positions.size()) {
      throw std::invalid_argument(
          fmt::format("there are {} normals for {} points", component.size(), positions.size()));
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double square = 0.0;
    for (const auto& component : normal) square += static_cast<double>(component[i]) * component[i];
    if (!(square > 0.0 && std::isfinite(square))) {
      throw std::invalid_argument(fmt::format("normal of point {} is ({}, {}, {}); it must have a length", i,
                                              normal[0][i], normal[1][i], normal[2][i]));
    }
  }
}

Vec<3> unit_tangent(const Vec<3>& direction, const Vec<3>& normal) {
  const Vec<3> tangent = direction - glm::dot(direction, normal) * normal;
  const double length = glm::length(tangent);
  // Single-precision input leaves nothing but rounding below this.
  if (length <= 1e-6 * glm::length(direction)) return any_tangent(normal);
  return tangent / length;
}

}  // namespace solidnoise
