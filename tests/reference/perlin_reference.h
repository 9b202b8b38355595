#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "solidnoise/noise/gradient/gradient_lattice.h"

namespace solidnoise::reference {

// Perlin's gradient noise with the quintic interpolant (Perlin 2002) and unit gradients, point by point and
// in lattice units; in place of 12 gradients the 256 of Kensler et al. 2008, section 2. The hash is the
// classic chain of look-ups in one permutation, P[P[P[i] + j] + k], or the exclusive-or of one for each axis.
// It has in common with the library the random tables only.
template <int Dim, typename Real = double>
class PerlinProcedure {
 public:
  enum class Hash { chained, xor_tables };

  PerlinProcedure(Hash hash, std::uint64_t seed) : hash_(hash), permutations_(make_permutations<Dim>(seed)) {
    const auto gradients = make_gradients<Dim>(seed);
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      for (int axis = 0; axis < Dim; ++axis) {
        gradients_[i][static_cast<std::size_t>(axis)] = static_cast<Real>(gradients[i][axis]);
      }
    }
  }

  Real operator()(const std::array<Real, Dim>& point) const {
    std::array<std::int32_t, Dim> cell;
    std::array<Real, Dim> fraction;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const Real corner = std::floor(point[axis]);
      cell[axis] = static_cast<std::int32_t>(corner);
      fraction[axis] = point[axis] - corner;
    }
    Real sum = 0;
    for (unsigned bits = 0; bits < (1u << Dim); ++bits) sum += term(cell, fraction, bits);
    return sum;
  }

 private:
  // One corner of the cell.
  Real term(const std::array<std::int32_t, Dim>& cell, const std::array<Real, Dim>& fraction,
            unsigned bits) const {
    std::size_t hash = 0;
    std::array<Real, Dim> offset;
    Real weight = 1;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const auto step = static_cast<std::int32_t>((bits >> axis) & 1u);
      const auto coordinate = static_cast<std::size_t>((cell[axis] + step) & 255);
      if (hash_ == Hash::chained) {
        hash = permutations_[0][(hash + coordinate) & 255u];
      } else {
        hash ^= permutations_[axis][coordinate];
      }
      offset[axis] = fraction[axis] - static_cast<Real>(step);
      const Real distance = std::abs(offset[axis]);
      const Real t = 1 - distance;
      weight *= t * t * t * (t * (t * 6 - 15) + 10);
    }
    Real dot = 0;
    for (std::size_t axis = 0; axis < Dim; ++axis) dot += offset[axis] * gradients_[hash][axis];
    return weight * dot;
  }

  Hash hash_;
  std::array<std::array<std::uint8_t, 256>, Dim> permutations_;
  std::array<std::array<Real, Dim>, kGradients> gradients_;
};

}  // namespace solidnoise::reference
