#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/point_cluster.h"

namespace solidnoise {

// A point as one grid of cells sees it; lengths in cells.
template <int Dim>
struct LocatedPoint {
  Index<Dim> cell;
  std::array<float, Dim> fraction;  // position in the cell, 0 to 1
  float radius;                     // of the kernel
  float density;                    // (r / 2^l)^n
  float weight;                     // of the sum over this grid's impulses
  std::array<float, 3> normal;      // of a surface
  std::uint32_t point;              // in the batch
};

// Position relative to the corner of a cell not far away, exact.
template <int Dim>
float from_anchor(const LocatedPoint<Dim>& point, const Index<Dim>& anchor, int axis) {
  return static_cast<float>(point.cell[axis] - anchor[axis]) + point.fraction[static_cast<std::size_t>(axis)];
}

// A tile is a run of points that are near each other, for which impulses are gathered together.
inline constexpr std::size_t kTilePoints = 384;
inline constexpr std::int64_t kTileCells = 3;  // most cells along an axis that the points of a tile lie in

// How many of the first points form a tile.
template <int Dim>
std::size_t tile_size(std::span<const LocatedPoint<Dim>> points);

// How the kernels extend around their points.
struct KernelExtent {
  // Half the thickness of the layer around a surface, in kernel radii; 0: no layer, the kernel is a ball.
  double layer = 0.0;
  bool fade = false;  // whether impulses are of interest in their turn only (ScaleTransition::fade)

  double reach() const { return std::hypot(1.0, layer); }  // farthest impulse, in kernel radii
};

// Where the impulses are that some points need; positions relative to the cell `anchor`.
template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const Index<Dim>& anchor,
                 const KernelExtent& extent);

// Whether a cell may hold any of these.
template <int Dim>
bool reaches(const PointCull& cull, const Index<Dim>& cell) {
  float square = 0.0f;
  float along = 0.0f;
  float half = 0.0f;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto lower = static_cast<float>(cell[axis]);
    const float excess = std::max({lower - cull.upper[a], cull.lower[a] - lower - 1.0f, 0.0f});
    square += excess * excess;
    if (axis < 3) {
      along += cull.normal[a] * (lower + 0.5f);
      half += 0.5f * std::abs(cull.normal[a]);
    }
  }
  return square <= cull.reach * cull.reach * 1.0001f && along + half >= cull.below &&
         along - half <= cull.above;
}

// Calls visit(cell) for each of these cells, relative to the anchor, in lexicographic order.
template <int Dim, typename Visit>
void for_each_reaching_cell(const PointCull& cull, const Visit& visit) {
  Index<Dim> first, last;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    first[axis] = static_cast<std::int64_t>(std::floor(cull.lower[a] - cull.reach));
    last[axis] = static_cast<std::int64_t>(std::floor(cull.upper[a] + cull.reach));
  }
  Index<Dim> cell = first;
  while (true) {
    if (reaches<Dim>(cull, cell)) visit(cell);
    int axis = Dim - 1;
    while (axis >= 0 && ++cell[axis] > last[axis]) {
      cell[axis] = first[axis];
      --axis;
    }
    if (axis < 0) return;
  }
}

extern template std::size_t tile_size(std::span<const LocatedPoint<2>>);
extern template std::size_t tile_size(std::span<const LocatedPoint<3>>);
extern template std::size_t tile_size(std::span<const LocatedPoint<4>>);
extern template PointCull bounds(std::span<const LocatedPoint<2>>, const Index<2>&, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<3>>, const Index<3>&, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<4>>, const Index<4>&, const KernelExtent&);

}  // namespace solidnoise
