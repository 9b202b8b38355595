#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/common.hpp>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/field.h"
#include "solidnoise/noise/convolution/impulse_sums.h"

namespace solidnoise {

// Sums at scattered points over what lies in the cells around them: impulses, or the points of a lattice.

// A point as a grid of cells sees it.
template <int Dim>
struct CellPoint {
  Index<Dim> cell;
  std::array<float, Dim> fraction;  // position in the cell, 0 to 1
  std::size_t sample;               // which point it is
};

// The points in an order in which those of one group of cells, of one of its cells, of one part of a cell
// follow each other.
template <int Dim>
std::vector<CellPoint<Dim>> order_by_cell(const Points<Dim>& points, const std::array<CellAxis, Dim>& axes);

// Cells of a group along each axis, and parts of a cell, as powers of 2.
inline constexpr int kGroupBits = 3;

template <int Dim>
bool in_one_group(const CellPoint<Dim>& a, const CellPoint<Dim>& b) {
  for (int axis = 0; axis < Dim; ++axis) {
    if (a.cell[axis] >> kGroupBits != b.cell[axis] >> kGroupBits) return false;
  }
  return true;
}

// A box of cells.
template <int Dim>
struct CellSpan {
  Index<Dim> first{0};
  Index<Dim> last{0};
};
template <int Dim>
CellSpan<Dim> joined(const CellSpan<Dim>& cells, const CellPoint<Dim>& point) {
  return {glm::min(cells.first, point.cell), glm::max(cells.last, point.cell)};
}
// The smallest that some points lie in; at least one.
template <int Dim>
CellSpan<Dim> cells_of(std::span<const CellPoint<Dim>> points) {
  CellSpan<Dim> cells{points.front().cell, points.front().cell};
  for (const CellPoint<Dim>& point : points) cells = joined(cells, point);
  return cells;
}

// Overwrites `samples` by sums that a source makes for clusters of points:
//   const std::array<CellAxis, Dim>& axes() const;
//   std::size_t enter(std::span<const CellPoint<Dim>>);  a group of points: how many of the first of them,
//   one at least, have their clusters next; it is asked again for the others
//   bool may_share(const CellPoint<Dim>&, const CellPoint<Dim>&) const;  a cluster
//   const ClusterSums& sum(std::span<const CellPoint<Dim>>);  of a cluster, up to SampleCluster::kSamples
//   int role(int axis) const;     where the sums have the gradient along an axis
//   float amplitude() const;      of the values,
//   float slope(int axis) const;  and of the gradient
template <int Dim, typename Source>
void sum_by_cell(const Points<Dim>& points, const Samples<Dim>& samples, Source&& source) {
  require_room(samples, points.size());
  const std::vector<CellPoint<Dim>> ordered = order_by_cell<Dim>(points, source.axes());
  std::span<const CellPoint<Dim>> rest = ordered;
  // Takes points from the front of others, as far as they belong to the first one.
  const auto take = [](std::span<const CellPoint<Dim>>& from, std::size_t most, const auto& belongs) {
    std::size_t count = 1;
    while (count < std::min(most, from.size()) && belongs(from.front(), from[count])) ++count;
    const auto taken = from.first(count);
    from = from.subspan(count);
    return taken;
  };
  while (!rest.empty()) {
    std::span<const CellPoint<Dim>> group = take(rest, rest.size(), in_one_group<Dim>);
    std::size_t entered = 0;
    while (!group.empty()) {
      if (entered == 0) entered = source.enter(group);
      const auto cluster = take(group, std::min<std::size_t>(SampleCluster::kSamples, entered),
                                [&](const auto& a, const auto& b) { return source.may_share(a, b); });
      entered -= cluster.size();
      const ClusterSums& sums = source.sum(cluster);
      for (std::size_t i = 0; i < cluster.size(); ++i) {
        const std::size_t sample = cluster[i].sample;
        samples.values[sample] = source.amplitude() * sums.value[i];
        for (int axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
          samples.gradient[static_cast<std::size_t>(axis)][sample] =
              source.slope(axis) * sums.gradient[source.role(axis)][i];
        }
      }
    }
  }
}

}  // namespace solidnoise
