#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/gradient_lattice.h"

// Kensler's gradient noise point by point, for comparison with the library.
namespace solidnoise::reference {

// The paper's procedure (Kensler et al. 2008, sections 2 and 3 and the pseudocode of section 4 without the
// projection), in n dimensions and in lattice units. It has in common with the library the random tables
// only.
template <int Dim>
class KenslerProcedure {
 public:
  using Position = std::array<double, Dim>;

  struct Setting {
    double c1 = 4.0;
    double c2 = 3.0;
    int stride = 1;                             // of the lattice points: 2 for the half-resolution grid
    std::array<std::int64_t, Dim> period = {};  // lattice steps; 0: none
    bool integer_hash = false;
    std::uint64_t seed = 0;
  };

  explicit KenslerProcedure(const Setting& setting)
      : setting_(setting),
        permutations_(make_permutations<Dim>(setting.seed)),
        gradients_(make_gradients<Dim>(setting.seed)) {}

  double operator()(const Position& point) const {
    // The stencil: 4 lattice points per axis, -1 to 2 from the cell's corner; 0 and 1 (times 2) of the
    // coarser grid.
    std::array<std::int64_t, Dim> corner;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      corner[axis] = static_cast<std::int64_t>(std::floor(point[axis] / setting_.stride)) * setting_.stride;
    }
    std::array<std::int64_t, Dim> lattice_point;
    Position offset;
    return sum_from_axis<0>(point, corner, lattice_point, offset, 0.0);
  }

 private:
  template <std::size_t Axis>
  double sum_from_axis(const Position& point, const std::array<std::int64_t, Dim>& corner,
                       std::array<std::int64_t, Dim>& lattice_point, Position& offset, double squared) const {
    if constexpr (Axis == Dim) {
      if (squared >= 4.0) return 0.0;
      const std::size_t h = hash(lattice_point);
      double dot = 0.0;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        dot += offset[axis] * gradients_[h][static_cast<glm::length_t>(axis)];
      }
      const double t = 1.0 - squared / 4.0;
      const double t4 = t * t * t * t;
      return dot * (setting_.c1 * t4 * t - setting_.c2 * t4);
    } else {
      const int first = setting_.stride == 1 ? -1 : 0;
      const int last = setting_.stride == 1 ? 2 : 1;
      double sum = 0.0;
      for (int step = first; step <= last; ++step) {
        lattice_point[Axis] = corner[Axis] + step * setting_.stride;
        offset[Axis] = point[Axis] - static_cast<double>(lattice_point[Axis]);
        sum += sum_from_axis<Axis + 1>(point, corner, lattice_point, offset,
                                       squared + offset[Axis] * offset[Axis]);
      }
      return sum;
    }
  }

  std::size_t hash(const std::array<std::int64_t, Dim>& lattice_point) const {
    std::size_t exclusive_or = 0;
    Index<Dim> wrapped;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      std::int64_t i = lattice_point[axis];
      if (setting_.period[axis] > 0)
        i = (i % setting_.period[axis] + setting_.period[axis]) % setting_.period[axis];
      wrapped[static_cast<glm::length_t>(axis)] = i;
      exclusive_or ^= permutations_[axis][static_cast<std::size_t>(i & 255)];
    }
    return setting_.integer_hash ? hash_cell<Dim>(wrapped, gradient_hash_key(setting_.seed)) & 255u
                                 : exclusive_or;
  }

  Setting setting_;
  std::array<std::array<std::uint8_t, 256>, Dim> permutations_;
  std::array<Vec<Dim>, kGradients> gradients_;
};

}  // namespace solidnoise::reference
