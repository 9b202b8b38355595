#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Parameters that a noise has at each evaluation point, one float per point. Where a span is empty, the
// noise's options hold for all points.
template <int Dim>
struct VaryingParameters {
  std::span<const float> frequency;  // principal frequency F0, cycles per world unit; > 0
  std::span<const float> bandwidth;  // octaves; 0.1 to 4
  std::span<const float> magnitude;  // standard deviation of the value; >= 0
  // Along which the waves of an oriented kernel travel; any length, and either sign: a direction and its
  // opposite give the same value. Where it is 0 (or, on a surface, along the normal) an arbitrary direction
  // is taken. All empty, or none.
  std::array<std::span<const float>, Dim> direction;

  // Throws std::invalid_argument naming the first point whose parameter is not allowed, its value and what is
  // allowed; or a span whose size is not `count`.
  void validate(std::size_t count) const;

  bool radius_varies() const { return !frequency.empty() || !bandwidth.empty(); }
};

// Throws std::invalid_argument naming the first point whose position is not finite.
template <int Dim>
void require_finite_positions(const Points<Dim>& points);

extern template struct VaryingParameters<2>;
extern template struct VaryingParameters<3>;
extern template struct VaryingParameters<4>;
extern template void require_finite_positions(const Points<2>&);
extern template void require_finite_positions(const Points<3>&);
extern template void require_finite_positions(const Points<4>&);

}  // namespace solidnoise
