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

[[noreturn]] void refuse_point(const CellAxis& axis, double coordinate, std::size_t point);
// Where a coordinate of a point lies in the cells. Throws std::invalid_argument, naming the point, where it
// is 2^40 cells or more from 0: positions in the cells would lose digits, and then overflow.
inline CellPosition locate_point(const CellAxis& axis, double coordinate, std::size_t point) {
  if (!(std::abs(coordinate) < CellAxis::kMostCells * axis.size())) refuse_point(axis, coordinate, point);
  return axis.locate(coordinate);
}

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
  int span = 1;        // ImpulseProcess::span()
  bool fade = false;   // whether impulses are of interest in their turn only (ScaleTransition::fade)

  explicit KernelExtent(double layer_) : layer(static_cast<float>(layer_)), reach(std::hypot(1.0f, layer)) {}
};

// Where the impulses are that some points of a tile need.
template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const KernelExtent& extent);

// The same of all points of two sets together, but that it knows of no layer.
PointCull joined(const PointCull& a, const PointCull& b);

// The same in cells of twice the size, relative to the one that the anchor lies in. `offset`: the anchor's
// corner in that cell, in cells of the smaller size, 0 or 1 per role. Turns are not changed.
PointCull coarsened(const PointCull& cull, const std::array<float, kRoles>& offset);

// The strata along one role that may hold impulses of interest.
struct CellRange {
  static constexpr int kMost = 40;

  int first = 0;
  int count = 0;
  std::array<float, kMost> square;  // squared distance from the points' box, along the role
  std::array<float, kMost> along;   // of a stratum's middle, along the normal

  CellRange(const PointCull& cull, Role role);

  // The first and the last of the strata whose `along` is between two numbers, or one more on either side.
  std::pair<int, int> between(float lower, float upper) const;
};

// Calls visit(stratum) for each stratum that may hold impulses that are not culled, relative to the anchor,
// in lexicographic order.
template <int Dim, typename Visit>
void for_each_reaching_cell(const PointCull& cull, const Visit& visit) {
  const CellRange last(cull, role_of_axis<Dim>(Dim - 1));
  const float most = cull.reach * cull.reach * 1.0001f;
  const float half =
      0.5f * cull.span * (std::abs(cull.normal[0]) + std::abs(cull.normal[1]) + std::abs(cull.normal[2])) +
      1e-4f;
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

// Sums over impulses at points of one grid of cells, tile by tile. A source has these, and what is in them:
//   void gather(const Index<Dim>& anchor, const PointCull&, ImpulseList&);  appends the impulses of a tile
//   void sum(std::span<const LocatedPoint<Dim>>, PointCluster&, ImpulseList&, ClusterSums&);  at a cluster of
//   points, of which it fills in what its kernel wants to know besides places, extents and normals
template <int Dim, typename Source>
class TiledSum {
 public:
  // `attributes` of an impulse.
  TiledSum(Source& source, const KernelExtent& extent, int attributes)
      : source_(source), extent_(extent), attributes_(attributes) {}

  // Adds the sum at each point, times its weight, to the value that it is the number of.
  void add(std::span<LocatedPoint<Dim>> points, std::span<float> values) {
    while (!points.empty()) {
      const PointTile<Dim> tile(points);
      gathered_.clear();
      source_.gather(tile.anchor, bounds<Dim>(tile.points, extent_), gathered_);
      for (std::size_t first = 0; first < tile.points.size(); first += kPatchPoints) {
        add_patch(tile.points.subspan(first, std::min(kPatchPoints, tile.points.size() - first)), values);
      }
    }
  }

 private:
  using Located = std::span<const LocatedPoint<Dim>>;

  void add_patch(Located points, std::span<float> values) {
    constexpr std::size_t kSamples = PointCluster::kSamples;
    std::array<PointCull, kPatchPoints / kSamples> culls;
    const std::size_t count = (points.size() + kSamples - 1) / kSamples;
    const auto cluster = [&](std::size_t i) {
      return points.subspan(i * kSamples, std::min(kSamples, points.size() - i * kSamples));
    };
    for (std::size_t i = 0; i < count; ++i) {
      culls[i] = bounds<Dim>(cluster(i), extent_);
      culls[i].attributes = attributes_;
    }
    PointCull all = culls[0];
    for (std::size_t i = 1; i < count; ++i) all = joined(all, culls[i]);
    near_.clear();
    cull_impulses(gathered_, all, near_);
    for (std::size_t i = 0; i < count; ++i) {
      kept_.clear();
      cull_impulses(near_, culls[i], kept_);
      add_cluster(cluster(i), values);
    }
  }

  void add_cluster(Located points, std::span<float> values) {
    cluster_.count = static_cast<int>(points.size());
    for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
      const LocatedPoint<Dim>& point = points[std::min(lane, points.size() - 1)];
      for (int axis = 0; axis < Dim; ++axis) {
        cluster_.coordinate[role_of_axis<Dim>(axis)][lane] = point.at[static_cast<std::size_t>(axis)];
      }
      cluster_.density[lane] = point.density;
      for (std::size_t axis = 0; extent_.layer > 0.0f && axis < 3; ++axis) {
        cluster_.normal[axis][lane] = point.normal[axis];
      }
      if (point.radius == radius_[lane]) continue;  // most often
      radius_[lane] = point.radius;
      const float height = point.radius * extent_.layer;
      cluster_.inverse_square_radius[lane] = 1.0f / (point.radius * point.radius);
      cluster_.inverse_square_height[lane] = 1.0f / (height * height);
    }
    ClusterSums sums;
    source_.sum(points, cluster_, kept_, sums);
    for (std::size_t i = 0; i < points.size(); ++i) {
      values[points[i].point] += points[i].weight * sums.value[i];
    }
  }

  Source& source_;
  const KernelExtent& extent_;
  int attributes_;
  ImpulseList gathered_{Dim};  // of a tile
  ImpulseList near_{Dim};      // of a patch
  ImpulseList kept_{Dim};      // of a cluster
  PointCluster cluster_;
  std::array<float, PointCluster::kSamples> radius_{};  // that the cluster's extents are of
};

extern template struct PointTile<2>;
extern template struct PointTile<3>;
extern template struct PointTile<4>;
extern template PointCull bounds(std::span<const LocatedPoint<2>>, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<3>>, const KernelExtent&);
extern template PointCull bounds(std::span<const LocatedPoint<4>>, const KernelExtent&);

}  // namespace solidnoise
