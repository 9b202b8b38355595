#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/point/point_cluster.h"

namespace solidnoise {

// A point as one grid of cells sees it; lengths in cells.
template <int Dim>
struct LocatedPoint {
  Index<Dim> cell;
  std::array<float, Dim> fraction;  // position in the cell, 0 to 1
  std::array<float, Dim> at;        // position relative to the tile's anchor
  float radius;                     // of the kernel
  float height;                     // half the thickness of its layer, where there is one
  float density;                    // (r / 2^l)^n
  float weight;                     // of the sum over this grid's impulses
  std::array<float, 3> normal;      // of a surface
  std::uint32_t point;              // in the batch
};

[[noreturn]] void refuse_point(const CellAxis& axis, double coordinate, std::size_t point);
// Where a coordinate of a point lies in the cells. Throws std::invalid_argument, naming the point, where it
// is 2^40 cells or more from 0: positions in the cells would lose digits, and then overflow.
inline CellPosition locate_point(const CellAxis& axis, double coordinate, std::size_t point) {
  if (!(std::abs(coordinate) < CellAxis::kMostCells * axis.size())) refuse_point(axis, coordinate, point);
  return axis.locate(coordinate);
}

// A tile is a run of points that are near each other, for which impulses are gathered together, as long as
// there are fewer cells around all of them than around each.
inline constexpr std::size_t kTilePoints = 2048;
inline constexpr std::size_t kPatchPoints = 64;  // of a tile, for a first culling
// Cells from the anchor in which positions in a cell's quanta are exact: points and the impulses in their
// reach are nearer, where kernels are not so large that this is no tile at all.
inline constexpr float kExactCells = 16.0f;

// Takes a tile from the front of `points`: relates its points to a cell near them, its anchor. Differences
// between positions relative to the anchor are exact.
template <int Dim>
struct PointTile {
  explicit PointTile(std::span<LocatedPoint<Dim>>& points);

  std::span<const LocatedPoint<Dim>> points;
  Index<Dim> anchor;
};

// How the kernels extend around their points.
struct KernelExtent {
  // Half the thickness of the layer around a surface, in kernel radii; 0: no layer, the kernel is a ball.
  float layer = 0.0f;
  float reach = 1.0f;  // farthest impulse, in kernel radii
  float span = 1.0f;   // cells that the impulses of one may lie in
  bool fade = false;   // whether impulses are of interest in their turn only (ScaleFade)

  explicit KernelExtent(double layer_) : layer(static_cast<float>(layer_)), reach(std::hypot(1.0f, layer)) {}
};

// Where the impulses are that some points of a tile need.
template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const KernelExtent& extent);

// Where those are that the points of two sets need together; it knows of no layer.
PointCull joined(const PointCull& a, const PointCull& b);

// A cull in cells of twice the size, relative to the one that the anchor lies in. `offset`: the anchor's
// corner in that cell, in cells of the smaller size, 0 or 1 per role. Turns are not changed.
PointCull coarsened(const PointCull& cull, const std::array<float, kRoles>& offset);

// A cull as a process takes it.
template <int Dim>
ImpulseReach<Dim> reach_of(const Index<Dim>& anchor, const PointCull& cull) {
  ImpulseReach<Dim> reach{anchor, anchor};
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Role role = role_of_axis<Dim>(axis);
    reach.lower[a] = cull.lower[role];
    reach.upper[a] = cull.upper[role];
    reach.scale[a] = 1.0f / cull.reach;
  }
  return reach;
}

// The strata along one role that may hold impulses of interest.
struct CellRange {
  static constexpr int kMost = 128;

  int first = 0;
  int count = 0;
  std::array<float, kMost> square;  // squared distance from the points' box, along the role
  std::array<float, kMost> along;   // of a stratum's middle, along the normal

  CellRange(const PointCull& cull, Role role);

  // The first and the last of the strata whose `along` is between two numbers, or one more on either side.
  std::pair<int, int> between(float lower, float upper) const;
};

// Calls visit(first, last) for the strata, side by side along the last axis, that may hold impulses that are
// not culled, relative to the anchor, in lexicographic order.
template <int Dim, typename Visit>
void for_each_reaching_row(const PointCull& cull, const Visit& visit) {
  const CellRange last(cull, role_of_axis<Dim>(Dim - 1));
  const float most = cull.reach * cull.reach * 1.0001f;
  const float half =
      0.5f * cull.span * (std::abs(cull.normal[0]) + std::abs(cull.normal[1]) + std::abs(cull.normal[2])) +
      1e-4f;
  const float below = cull.below - half;
  const float above = cull.above + half;
  Index<Dim> cell;
  const auto visit_row = [&](float square, float along) {
    auto [from, to] = last.between(below - along, above - along);
    const auto beyond = [&](int i) { return square + last.square[static_cast<std::size_t>(i)] > most; };
    while (from <= to && beyond(from)) ++from;
    while (from <= to && beyond(to)) --to;
    if (from > to) return;
    Index<Dim> end = cell;
    cell[Dim - 1] = last.first + from;
    end[Dim - 1] = last.first + to;
    visit(cell, end);
  };
  const auto visit_axis = [&]<int kAxis>(const auto& self, float square, float along) {
    if constexpr (kAxis == Dim - 1) {
      visit_row(square, along);
    } else {
      const CellRange range(cull, role_of_axis<Dim>(kAxis));
      for (int i = 0; i < range.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (square + range.square[k] > most) continue;
        cell[kAxis] = range.first + i;
        self.template operator()<kAxis + 1>(self, square + range.square[k], along + range.along[k]);
      }
    }
  };
  visit_axis.template operator()<0>(visit_axis, 0.0f, 0.0f);
}

}  // namespace solidnoise
