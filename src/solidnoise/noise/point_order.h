#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/core/points.h"

namespace solidnoise {

// The points' numbers in an order that keeps neighbours together: along a Morton curve through their bounding
// box. Dim is 2 to 4; positions finite. The order decides the speed of an evaluation, not its result.
template <int Dim>
std::vector<std::size_t> spatial_order(const Points<Dim>& points);

extern template std::vector<std::size_t> spatial_order(const Points<2>&);
extern template std::vector<std::size_t> spatial_order(const Points<3>&);
extern template std::vector<std::size_t> spatial_order(const Points<4>&);

}  // namespace solidnoise
