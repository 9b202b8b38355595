#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// For each position the first one that is equal to it, but for the sign of zeros.
std::vector<std::uint32_t> first_at_position(const std::vector<Vec<3>>& positions);

// For each position one that is no farther from it than the gaps of both, or itself. None comes after it; it
// may have an earlier one itself. `gaps` has one for each position; where it is 0, the position stays alone.
std::vector<std::uint32_t> first_across_gap(const std::vector<Vec<3>>& positions,
                                            const std::vector<double>& gaps);

}  // namespace solidnoise
