#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/gradient/gradient_lattice.h"

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
    const int first = setting_.stride == 1 ? -1 : 0;
    Stencil stencil;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const double corner = std::floor(point[axis] / setting_.stride);
      for (int step = 0; step < points_per_axis(); ++step) {
        const double lattice_point = (corner + first + step) * setting_.stride;
        const std::size_t at = static_cast<std::size_t>(step);
        stencil.offset[axis][at] = point[axis] - lattice_point;
        stencil.lattice_point[axis][at] = wrap(static_cast<std::int64_t>(lattice_point), axis);
        stencil.permuted[axis][at] =
            permutations_[axis][static_cast<std::size_t>(stencil.lattice_point[axis][at] & 255)];
      }
    }
    std::array<std::size_t, Dim> chosen;
    return setting_.stride == 1 ? sum_from_axis<0, 4>(stencil, chosen, 0.0, 0)
                                : sum_from_axis<0, 2>(stencil, chosen, 0.0, 0);
  }

 private:
  struct Stencil {
    std::array<std::array<double, 4>, Dim> offset;
    std::array<std::array<std::int64_t, 4>, Dim> lattice_point;
    std::array<std::array<std::size_t, 4>, Dim> permuted;
  };

  int points_per_axis() const { return setting_.stride == 1 ? 4 : 2; }

  std::int64_t wrap(std::int64_t i, std::size_t axis) const {
    const std::int64_t period = setting_.period[axis];
    return period == 0 ? i : (i % period + period) % period;
  }

  template <std::size_t Axis, std::size_t kPoints>
  double sum_from_axis(const Stencil& stencil, std::array<std::size_t, Dim>& chosen, double squared,
                       std::size_t hash) const {
    if constexpr (Axis == Dim) {
      if (squared >= 4.0) return 0.0;
      const Vec<Dim>& gradient = gradients_[setting_.integer_hash ? integer_hash(stencil, chosen) : hash];
      double dot = 0.0;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        dot += stencil.offset[axis][chosen[axis]] * gradient[static_cast<glm::length_t>(axis)];
      }
      const double t = 1.0 - squared / 4.0;
      const double t4 = (t * t) * (t * t);
      return dot * (setting_.c1 * t4 * t - setting_.c2 * t4);
    } else {
      double sum = 0.0;
      for (std::size_t step = 0; step < kPoints; ++step) {
        chosen[Axis] = step;
        const double offset = stencil.offset[Axis][step];
        sum += sum_from_axis<Axis + 1, kPoints>(stencil, chosen, squared + offset * offset,
                                                hash ^ stencil.permuted[Axis][step]);
      }
      return sum;
    }
  }

  std::size_t integer_hash(const Stencil& stencil, const std::array<std::size_t, Dim>& chosen) const {
    Index<Dim> point;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      point[static_cast<glm::length_t>(axis)] = stencil.lattice_point[axis][chosen[axis]];
    }
    return hash_cell<Dim>(point, gradient_hash_key(setting_.seed)) & 255u;
  }

  Setting setting_;
  std::array<std::array<std::uint8_t, 256>, Dim> permutations_;
  std::array<Vec<Dim>, kGradients> gradients_;
};

}  // namespace solidnoise::reference
