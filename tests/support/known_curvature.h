#pragma once

#include <cmath>

#include <glm/geometric.hpp>

#include "solidnoise/core/vec.h"

// The principal curvatures of the surfaces of surfaces.h, positive where they bend away from their normal.
namespace solidnoise {

struct PrincipalCurvatures {
  double k1;
  double k2;

  double mean() const { return 0.5 * (k1 + k2); }
  double gaussian() const { return k1 * k2; }
};

inline PrincipalCurvatures from_mean_and_gaussian(double mean, double gaussian) {
  const double half_difference = std::sqrt(std::fmax(mean * mean - gaussian, 0.0));
  return {mean + half_difference, mean - half_difference};
}

// Of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1, from its distance d of the tangent plane to the centre:
// K = d^4 / (abc)^2 and H = d^3 (a^2 + b^2 + c^2 - |p|^2) / (2 (abc)^2).
inline PrincipalCurvatures ellipsoid_curvature(const Vec<3>& half_axes, const Vec<3>& p) {
  const Vec<3> squares = half_axes * half_axes;
  const double d = 1.0 / glm::length(p / squares);
  const double volume = squares.x * squares.y * squares.z;
  const double mean = d * d * d * (squares.x + squares.y + squares.z - glm::dot(p, p)) / (2.0 * volume);
  return from_mean_and_gaussian(mean, d * d * d * d / volume);
}

// At a distance from the axis of major + minor cos(v): 1/minor around the tube, cos(v) / distance along it.
inline PrincipalCurvatures torus_curvature(double major, double minor, const Vec<3>& p) {
  const double from_axis = std::hypot(p.x, p.z);
  return {1.0 / minor, (from_axis - major) / (minor * from_axis)};
}

// A height z over the plane, by its derivatives.
struct GraphJet {
  double x, y, xx, xy, yy;
};

inline PrincipalCurvatures graph_curvature(const GraphJet& z) {
  const double w = 1.0 + z.x * z.x + z.y * z.y;
  const double mean = -((1.0 + z.y * z.y) * z.xx - 2.0 * z.x * z.y * z.xy + (1.0 + z.x * z.x) * z.yy) /
                      (2.0 * std::pow(w, 1.5));
  return from_mean_and_gaussian(mean, (z.xx * z.yy - z.xy * z.xy) / (w * w));
}

}  // namespace solidnoise
