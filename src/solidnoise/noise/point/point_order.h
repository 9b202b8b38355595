#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solidnoise/core/points.h"

namespace solidnoise {

// A point, by number, and its place in an order.
struct KeyedPoint {
  std::uint64_t key = 0;
  std::size_t point = 0;
};

// Sorts by the lowest `bits` bits of the keys, all others of which are 0. Points of equal keys stay as they
// are.
void sort_by_key(std::vector<KeyedPoint>& points, int bits);

// The points' numbers in an order that keeps neighbours together: along a Morton curve through their bounding
// box. Dim is 2 to 4; positions finite. The order decides the speed of an evaluation, not its result.
template <int Dim>
std::vector<std::size_t> spatial_order(const Points<Dim>& points);

extern template std::vector<std::size_t> spatial_order(const Points<2>&);
extern template std::vector<std::size_t> spatial_order(const Points<3>&);
extern template std::vector<std::size_t> spatial_order(const Points<4>&);

}  // namespace solidnoise
