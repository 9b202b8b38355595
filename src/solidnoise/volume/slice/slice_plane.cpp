#include "solidnoise/volume/slice/slice_plane.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

std::string text_of(const Vec<3>& vector) {
  return fmt::format("{} {} {}", vector.x, vector.y, vector.z);
}

Vec<3> unit(const char* name, const Vec<3>& vector) {
  const double length = glm::length(vector);
  if (!(length > 0.0)) {
    throw std::invalid_argument(fmt::format("{} is {}; it must have a length", name, text_of(vector)));
  }
  return vector / length;
}

// The part of `vector` across a unit vector, as a unit vector.
Vec<3> across(const Vec<3>& axis, const Vec<3>& vector) {
  const Vec<3> direction = unit("up", vector);
  const Vec<3> rest = direction - glm::dot(direction, axis) * axis;
  constexpr double kLeastSine = 1e-6;
  if (glm::length(rest) < kLeastSine) {
    throw std::invalid_argument(
        fmt::format("up is {}; it must not be parallel to {}", text_of(vector), text_of(axis)));
  }
  return glm::normalize(rest);
}

}  // namespace

double SlicePlane::coordinate(int column) const {
  return glm::dot(origin, right) + pixel * (column + 0.5 - 0.5 * columns);
}

void SlicePlane::face(const Vec<3>& normal, const Vec<3>& upward) {
  const Vec<3> towards = unit("normal", normal);
  up = across(towards, upward);
  right = glm::cross(up, towards);
}

void SlicePlane::span(const Vec<3>& rightward, const Vec<3>& upward) {
  right = unit("axes", rightward);
  up = across(right, upward);
}

}  // namespace solidnoise
