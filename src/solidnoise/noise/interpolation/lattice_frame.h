#pragma once

#include <cmath>
#include <cstdint>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// The lattice that a noise is to be evaluated on: sample i of an axis is at origin + step * i, world units.
// Blocks of it have other first samples and counts.
template <int Dim>
struct LatticeFrame {
  Vec<Dim> origin{0.0};
  Vec<Dim> step{1.0};  // > 0
  // Samples after which the noise repeats along each axis, and what is interpolated is to repeat, too; 0 for
  // never.
  glm::vec<Dim, int> period{0};
};

// The samples of a period (world units; 0 for none) where that is a whole number of steps, to a millionth of
// itself, as steps are that were typed in; else 0.
inline int whole_period(double period, double step) {
  constexpr double kTolerance = 1e-6;
  const double samples = period / step;
  const double whole = std::round(samples);
  if (whole > 0x1p30 || std::abs(samples - whole) > kTolerance * samples) return 0;
  return static_cast<int>(whole);
}

// The largest whole number that is no more than i / divisor; divisor > 0.
inline std::int64_t divide_down(std::int64_t i, int divisor) {
  const std::int64_t quotient = i / divisor;
  return quotient * divisor > i ? quotient - 1 : quotient;
}

}  // namespace solidnoise
