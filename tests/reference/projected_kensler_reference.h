#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/gradient/gradient_lattice.h"

namespace solidnoise::reference {

// Kensler's gradient noise projected on a surface, point by point and in lattice units (Kensler et al. 2008,
// section 4), with all lattice points in reach. It has in common with the library the random tables only.
struct ProjectedKensler {
  double c1 = 4.0;
  double c2 = 3.0;
  int stride =
      1;  // of the lattice points: 2 for the half-resolution grid, with a window as many times as wide
  bool cosine_window = false;
  bool integer_hash = false;
  std::uint64_t seed = 0;

  double window(double u) const {
    if (u >= 1.0) return 0.0;
    if (cosine_window) return std::cos(0.5 * std::numbers::pi * (3.0 * u * u - 2.0 * u * u * u));
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
          bool in_lattice = true;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            lattice_point[axis] = static_cast<std::int64_t>(std::floor(point[axis])) + step[axis];
            in_lattice = in_lattice && lattice_point[axis] % stride == 0;
            d[axis] = point[axis] - static_cast<double>(lattice_point[axis]);
            o += d[axis] * normal[axis];
          }
          if (!in_lattice) continue;
          std::size_t hash = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            hash ^= permutations[axis][static_cast<std::size_t>(lattice_point[axis] & 255)];
          }
          if (integer_hash) {
            hash = hash_cell<3>({lattice_point[0], lattice_point[1], lattice_point[2]},
                                gradient_hash_key(seed)) &
                   255u;
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
          sum += slope * (c1 * t4 * t - c2 * t4) * window(std::abs(o) / stride);
        }
      }
    }
    return sum;
  }
};

}  // namespace solidnoise::reference
