#pragma once

#include <algorithm>
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
  float density;                    // (r / 2^l)^n
  float weight;                     // of the sum over this grid's impulses
  std::array<float, 3> normal;      // of a surface
  std::uint32_t point;              // in the batch
};

// Where a coordinate of a point lies in the cells. Throws std::invalid_argument, naming the point, where it
// is 2^40 cells or more from 0: positions in the cells would lose digits, and then overflow.
CellPosition locate_point(const CellAxis& axis, double coordinate, std::size_t point);

// A tile is a run of points that are near each other, for which impulses are gathered together.
inline constexpr std::size_t kTilePoints = 512;
inline constexpr std::size_t kPatchPoints = 64;  // of a tile, for a first culling
// Most cells along an axis that the points of a tile lie in. Few points in many cells are gathered for
// together, as far as ImpulseCells can keep all cells around them.
template <int Dim>
inline constexpr std::int64_t kTileCells = Dim == 4 ? 3 : 6;

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
  bool fade = false;   // whether impulses are of interest in their turn only (ScaleTransition::fade)

  explicit KernelExtent(double layer_) : layer(static_cast<float>(layer_)), reach(std::hypot(1.0f, layer)) {}
};

// Where the impulses are that some points of a tile need.
template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const KernelExtent& extent);

// The same of all points of two sets together, but that it knows of no layer.
PointCull joined(const PointCull& a, const PointCull& b);

// The same in cells of twice the size, relative to the one that the anchor lies in. `offset`: the anchor's
// corner in that cell, in cells of the smaller size, 0 or 1 per axis. Turns are not changed.
PointCull coarsened(const PointCull& cull, const std::array<float, PointImpulses::kMaxAxes>& offset);

// The cells along one axis that may hold impulses of interest.
struct CellRange {
  static constexpr int kMost = 24;

  int first = 0;
  int count = 0;
  std::array<float, kMost> square;  // squared distance from the points' box, along this axis
  std::array<float, kMost> along;   // of a cell's middle, along the normal

  CellRange(const PointCull& cull, int axis);

  // The first and the last of the cells whose `along` is between two numbers, or one more on either side.
  std::pair<int, int> between(float lower, float upper) const;
};

// Calls visit(cell) for each cell that may hold impulses that are not culled, relative to the anchor, in
// lexicographic order.
template <int Dim, typename Visit>
void for_each_reaching_cell(const PointCull& cull, const Visit& visit) {
  const CellRange last(cull, Dim - 1);
  const float most = cull.reach * cull.reach * 1.0001f;
  const float half =
      0.5f * (std::abs(cull.normal[0]) + std::abs(cull.normal[1]) + std::abs(cull.normal[2])) + 1e-4f;
  const float below = cull.below - half;
  const float above = cull.above + half;
  Index<Dim> cell;
  const auto visit_row = [&](float square, float along) {
    const auto [from, to] = last.between(below - along, above - along);
    for (int i = from; i <= to; ++i) {
      if (square + last.square[static_cast<std::size_t>(i)] > most) continue;
      cell[Dim - 1] = last.first + i;
      visit(cell);
    }
  };
  const auto visit_axis = [&]<int kAxis>(const auto& self, float square, float along) {
    if constexpr (kAxis == Dim - 1) {
      visit_row(square, along);
    } else {
      const CellRange range(cull, kAxis);
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

extern template struct PointTile<2>;
extern template struct PointTile<3>;
extern template struct PointTile<4>;
extern template PointCull bounds(std::span<const LocatedPoint<2>>, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<3>>, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<4>>, const KernelExtent&);

// The impulses that the points of a tile need, from one grid or, with ScaleTransition::fade, from two.
template <int Dim>
class TileImpulses {
 public:
  // Collects them, cell by cell in lexicographic order, the finer grid first. `coarse` may be null.
  void gather(const PointTile<Dim>& tile, const KernelExtent& extent, ImpulseCells<Dim>& fine,
              ImpulseCells<Dim>* coarse);

  // Positions and turns in cells of the finer grid.
  const PointImpulses& impulses() const { return impulses_; }

 private:
  // A grid as the finer one sees it.
  struct Scale {
    float size = 1.0f;  // of a cell
    std::array<float, PointImpulses::kMaxAxes>
        offset{};  // from the corner of its anchor to the tile's anchor
    // With the radius r in cells of the finer grid, the y of an impulse is r^n times its turn: of a coarser
    // one it is (r / 2)^n times what it carries.
    float turn = 1.0f;
  };
  void append(std::span<const typename ImpulseCells<Dim>::Item> items, const Index<Dim>& cell,
              const Scale& scale, const PointCull& cull);

  PointImpulses impulses_;
};

template <int Dim>
void TileImpulses<Dim>::gather(const PointTile<Dim>& tile, const KernelExtent& extent,
                               ImpulseCells<Dim>& fine, ImpulseCells<Dim>* coarse) {
  const PointCull cull = bounds<Dim>(tile.points, extent);
  impulses_.clear();
  Scale scale;
  for_each_reaching_cell<Dim>(
      cull, [&](const Index<Dim>& cell) { append(fine.at(tile.anchor + cell), cell, scale, cull); });
  if (coarse == nullptr) return;

  Index<Dim> anchor;
  for (int axis = 0; axis < Dim; ++axis) {
    anchor[axis] = tile.anchor[axis] >> 1;
    scale.offset[static_cast<std::size_t>(axis)] = static_cast<float>(tile.anchor[axis] & 1);
  }
  scale.size = 2.0f;
  scale.turn = 1.0f / static_cast<float>(1 << Dim);
  for_each_reaching_cell<Dim>(coarsened(cull, scale.offset), [&](const Index<Dim>& cell) {
    append(coarse->at(anchor + cell), cell, scale, cull);
  });
}

template <int Dim>
void TileImpulses<Dim>::append(std::span<const typename ImpulseCells<Dim>::Item> items,
                               const Index<Dim>& cell, const Scale& scale, const PointCull& cull) {
  constexpr float kLowest = 1.0f / static_cast<float>(1 << Dim);
  impulses_.reserve(impulses_.size() + items.size());
  std::array<float*, Dim> position;
  std::array<float, Dim> corner;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    position[a] = impulses_.position(axis);
    corner[a] = static_cast<float>(cell[axis]) * scale.size - scale.offset[a];
  }
  float* const weight = impulses_.attribute(PointImpulses::kWeight);
  float* const turn = impulses_.attribute(PointImpulses::kTurn);
  std::size_t end = impulses_.size();
  for (const auto& item : items) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      position[axis][end] = corner[axis] + scale.size * item.position[axis];
    }
    weight[end] = item.weight;
    turn[end] = scale.turn * (kLowest + (1.0f - kLowest) * item.share);
    end += turn[end] >= cull.least_turn && turn[end] <= cull.most_turn ? 1 : 0;
  }
  impulses_.set_size(end);
}

}  // namespace solidnoise
