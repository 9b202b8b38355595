#pragma once

#include <array>
#include <cstddef>

#include "solidnoise/noise/convolution/impulse_cells.h"
#include "solidnoise/noise/point/point_tile.h"

namespace solidnoise {

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
