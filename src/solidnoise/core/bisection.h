#pragma once

#include <cmath>

namespace solidnoise {

// The x in [lower, upper] where a monotone function changes sign, to the last bits of double precision
// (relative to the larger end). Precondition: the function has different signs at the ends, or is 0 at one.
template <typename Function>
double bisect(const Function& function, double lower, double upper) {
  const bool negative_below = function(lower) < 0.0;
  const double resolution = 1e-15 * std::fmax(std::abs(lower), std::abs(upper));
  while (upper - lower > resolution) {
    const double middle = 0.5 * (lower + upper);
    if (middle == lower || middle == upper) break;
    ((function(middle) < 0.0) == negative_below ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

}  // namespace solidnoise
