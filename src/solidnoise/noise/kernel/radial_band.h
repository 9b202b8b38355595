#pragma once

#include <cmath>

#include "solidnoise/core/field.h"
#include "solidnoise/core/numerics.h"

namespace solidnoise {

// The frequencies between which all but a thousandth of the integral `total` of a radial power lies, half of
// that thousandth on either side. There is no power above `highest`; panels of a width are integrated at
// once.
template <typename Power>
Band radial_band(const Power& power, double total, double highest, double width) {
  constexpr double kTail = 5e-4;
  // Walks from `start` in panels until the tail is passed, then bisects within that panel.
  const auto edge = [&](double start, double panel) {
    double before = 0.0;
    for (double f = start;; f += panel) {
      const double within = std::abs(integrate(power, f, f + panel));
      if (before + within > kTail * total) {
        const auto excess = [&](double g) {
          return before + std::abs(integrate(power, f, g)) - kTail * total;
        };
        return panel > 0.0 ? bisect(excess, f, f + panel) : bisect(excess, f + panel, f);
      }
      before += within;
    }
  };
  return {edge(0.0, width), edge(highest, -width)};
}

}  // namespace solidnoise
