#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "solidnoise/noise/gradient/gradient_lattice.h"

namespace solidnoise::reference {

// Kensler's gradient noise projected on a surface, point by point and in lattice units (Kensler et al. 2008,
// section 4), with all lattice points in reach. It has in common with the library the random tables only.
struct ProjectedKensler {
  std::uint64_t seed = 0;

  static double window(double u) {
    if (u >= 1.0) return 0.0;
    const double o = 1.0 - u;
    return 3.0 * o * o - 2.0 * o * o * o;
  }

  double operator()(const std::array<double, 3>& point, const std::array<double, 3>& normal) const {
    const auto permutations = make_permutations<3>(seed);
    const auto gradients = make_gradients<3>(seed);
    double sum = 0.0;
    constexpr int kReach = 4;
    for (int k = -kReach; k <= kReach; ++k) {
      for (int j = -kReach; j <= kReach; ++j) {
        for (int i = -kReach; i <= kReach; ++i) {
          const std::array<int, 3> step{i, j, k};
          std::array<std::int64_t, 3> lattice_point;
          std::array<double, 3> d;
          double o = 0.0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            lattice_point[axis] = static_cast<std::int64_t>(std::floor(point[axis])) + step[axis];
            d[axis] = point[axis] - static_cast<double>(lattice_point[axis]);
            o += d[axis] * normal[axis];
          }
          std::size_t hash = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            hash ^= permutations[axis][static_cast<std::size_t>(lattice_point[axis] & 255)];
          }
          double squared = 0.0;
          double slope = 0.0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const double along = d[axis] - o * normal[axis];
            squared += along * along;
            slope += along * gradients[hash][static_cast<glm::length_t>(axis)];
          }
          if (squared >= 4.0) continue;
          const double t = 1.0 - squared / 4.0;
          const double t4 = (t * t) * (t * t);
          sum += slope * (4.0 * t4 * t - 3.0 * t4) * window(std::abs(o));
        }
      }
    }
    return sum;
  }
};

}  // namespace solidnoise::reference
