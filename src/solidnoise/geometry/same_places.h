#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// For each position the first one that is equal to it, but for the sign of zeros.
std::vector<std::uint32_t> first_at_position(const std::vector<Vec<3>>& positions);

// How far apart the sides of a seam may be by rounding, of a mesh whose box is so wide, next to an edge this
// long. Angles in single precision close a circle but for 1.7e-7 of its radius, 2^-23.5 of its diameter.
inline double seam_gap(double widest, double edge) {
  return std::min(0x1p-22 * widest, 0x1p-10 * edge);
}

// For each position one that is no farther from it than the gaps of both, or itself. None comes after it; it
// may have an earlier one itself. `gaps` has one for each position; where it is 0, the position stays alone.
std::vector<std::uint32_t> first_across_gap(const std::vector<Vec<3>>& positions,
                                            const std::vector<double>& gaps);

}  // namespace solidnoise
