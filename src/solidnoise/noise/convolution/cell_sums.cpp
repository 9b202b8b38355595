#include "solidnoise/noise/convolution/cell_sums.h"

#include <cstdint>

#include "solidnoise/core/points.h"
#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

constexpr int kHashBits = 32;

}  // namespace

// Groups are in the order of their hashes; two that share one are only slower.
template <int Dim>
std::vector<CellPoint<Dim>> order_by_cell(const Points<Dim>& points, const std::array<CellAxis, Dim>& axes) {
  std::vector<KeyedPoint> order(points.size());
  std::vector<CellPoint<Dim>> unordered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    CellPoint<Dim>& point = unordered[i];
    point.sample = i;
    Index<Dim> group;
    std::uint64_t cell = 0;
    std::uint64_t part = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const CellPosition position = axes[a].locate(points.coordinate(i, axis));
      point.cell[axis] = position.cell;
      point.fraction[a] = position.fraction;
      group[axis] = position.cell >> kGroupBits;
      cell = cell << kGroupBits | (static_cast<std::uint64_t>(position.cell) & ((1u << kGroupBits) - 1));
      part = part << kGroupBits | static_cast<std::uint64_t>(position.fraction * (1 << kGroupBits));
    }
    const std::uint64_t hash = hash_cell<Dim>(group, 0) >> (64 - kHashBits);
    order[i] = {(hash << (Dim * kGroupBits) | cell) << (Dim * kGroupBits) | part, i};
  }
  sort_by_key(order, kHashBits + 2 * Dim * kGroupBits);
  std::vector<CellPoint<Dim>> ordered;
  ordered.reserve(points.size());
  for (const KeyedPoint& point : order) ordered.push_back(unordered[point.point]);
  return ordered;
}

template std::vector<CellPoint<1>> order_by_cell<1>(const Points<1>&, const std::array<CellAxis, 1>&);
template std::vector<CellPoint<2>> order_by_cell<2>(const Points<2>&, const std::array<CellAxis, 2>&);
template std::vector<CellPoint<3>> order_by_cell<3>(const Points<3>&, const std::array<CellAxis, 3>&);
template std::vector<CellPoint<4>> order_by_cell<4>(const Points<4>&, const std::array<CellAxis, 4>&);

}  // namespace solidnoise
