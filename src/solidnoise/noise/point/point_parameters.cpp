#include "solidnoise/noise/point/point_parameters.h"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/noise.h"

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

namespace {

// Checks one value per point.
void require_each(std::string_view name, std::span<const float> values, std::size_t count,
                  const Interval& allowed, std::string_view unit) {
  if (values.empty()) return;
  if (values.size() != count) {
    throw std::invalid_argument(
        fmt::format("there are {} values of {} for {} points", values.size(), name, count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!allowed.contains(values[i]))
      require(fmt::format("{} of point {}", name, i), values[i], allowed, unit);
  }
}

}  // namespace

template <int Dim>
void VaryingParameters<Dim>::validate(std::size_t count) const {
  require_each("frequency", frequency, count, kFrequencies, "cycles per world unit");
  require_each("bandwidth", bandwidth, count,
               between(KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth), "octaves");
  require_each("magnitude", magnitude, count, between(0.0, kMostMagnitude), "standard deviation");
  for (const std::span<const float>& component : direction) {
    if (component.size() != direction[0].size()) {
      throw std::invalid_argument("direction has components of different size");
    }
    require_each("direction", component, count, kDirections, {});
  }
}

std::vector<float> pick(std::span<const float> from, std::span<const std::size_t> points) {
  if (from.empty()) return {};
  std::vector<float> picked(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) picked[i] = from[points[i]];
  return picked;
}

template <int Dim>
void require_finite_positions(const Points<Dim>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < Dim; ++axis) {
      const double coordinate = points.coordinate(i, axis);
      if (!std::isfinite(coordinate)) {
        throw std::invalid_argument(
            fmt::format("position of point {} is {} along axis {}; it must be finite", i, coordinate, axis));
      }
    }
  }
}

template struct VaryingParameters<3>;
template struct VaryingParameters<4>;
template void require_finite_positions(const Points<3>&);
template void require_finite_positions(const Points<4>&);

}  // namespace solidnoise
