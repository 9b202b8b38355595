#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/point/point_cluster.h"
#include "solidnoise/noise/point/point_parameters.h"
#include "solidnoise/noise/point/point_tile.h"
#include "solidnoise/noise/point/tiled_sum.h"

namespace solidnoise {

// Points of a surface that are near each other, and their unit frames; tangents only where they are wanted.
struct SurfaceBatch {
  std::span<const std::size_t> order;  // indices of the batch's points
  std::vector<Vec<3>> positions;       // one per point of the batch
  std::vector<Vec<3>> normals;         // one per point of the batch
  std::vector<Vec<3>> tangents;        // one per point of the batch, or none
};

// One call of sum_on_surface(), for one source.
template <typename Source>
class SurfaceSum {
 public:
  explicit SurfaceSum(const Source& source) : source_(source), extent_(source.layer()) {
    extent_.span = static_cast<float>(source.span());
  }

  // Adds to the samples of the batch's points.
  void add(const SurfaceBatch& batch, const Samples<3>& samples) {
    tangents_ = batch.tangents;
    located_.resize(batch.order.size());
    for (std::size_t i = 0; i < located_.size(); ++i) {
      LocatedPoint<3>& point = located_[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const CellPosition position = locate_point(source_.axis(), batch.positions[i][axis], batch.order[i]);
        point.cell[axis] = position.cell;
        point.fraction[a] = position.fraction;
        point.normal[a] = static_cast<float>(batch.normals[i][axis]);
      }
      point.radius = source_.radius();
      point.height = point.radius * extent_.layer;
      point.density = 1.0f;
      point.weight = 1.0f;
      point.point = static_cast<std::uint32_t>(i);
    }
    TiledSum<3, SurfaceSum>(*this, extent_, 3).add(located_, source_.axis().size(), samples);
  }

  void gather(const PointTile<3>& tile, const PointCull& cull, ImpulseList& impulses) const {
    const ImpulseReach<3> reach = reach_of<3>(tile.anchor, cull);
    for_each_reaching_row<3>(cull, [&](const Index<3>& first, const Index<3>& last) {
      source_.append(tile.anchor, first, last, reach, impulses);
    });
  }

  void sum(std::span<const LocatedPoint<3>> points, PointCluster& cluster, const ImpulseList& impulses,
           ClusterSums& sums) const {
    for (std::size_t lane = 0; !tangents_.empty() && lane < PointCluster::kSamples; ++lane) {
      const Vec<3>& tangent = tangents_[points[std::min(lane, points.size() - 1)].point];
      for (int axis = 0; axis < 3; ++axis) cluster.tangent[axis][lane] = static_cast<float>(tangent[axis]);
    }
    source_.sum(cluster, impulses, sums);
  }

 private:
  const Source& source_;
  KernelExtent extent_;
  std::span<const Vec<3>> tangents_;
  std::vector<LocatedPoint<3>> located_;
};

// The sum over several sources at points of a surface. A source has impulses of three attributes in a grid of
// cubic cells, and a kernel in a layer around the tangent plane, the same for all points:
//   const CellAxis& axis() const;  the cells, along each axis
//   float radius() const;          of the kernel along the surface, in cells
//   double layer() const;          half the layer's thickness, in radii
//   int span() const;              cells along an axis that the impulses of a stratum may lie in
//   void append(anchor, first, last, const ImpulseReach<3>&, ImpulseList&) const;  the impulses of strata
//   side by side along z, relative to the anchor; those that are out of reach may be left out void sum(const
//   PointCluster&, const ImpulseList&, ClusterSums&) const;
// `tangent` is all empty for kernels that need none. A value depends on its point only. The gradient is the
// part along the surface of the derivative by the position, while normal and tangent stay as they are.
template <typename Source>
void sum_on_surface(std::span<const Source> sources, const SurfacePoints& points,
                    const std::array<std::span<const float>, 3>& tangent, const Samples<3>& samples) {
  constexpr std::size_t kBatch = 4096;  // points that are located together
  require_room(samples, points.positions.size());
  std::vector<SurfaceSum<Source>> sums(sources.begin(), sources.end());
  const std::vector<std::size_t> order = spatial_order(points.positions);
  SurfaceBatch batch;
  for (std::size_t first = 0; first < order.size(); first += kBatch) {
    batch.order = std::span(order).subspan(first, std::min(kBatch, order.size() - first));
    // Positions are far apart in memory: fetched one after the other here, not between other work.
    const std::size_t count = batch.order.size();
    batch.positions.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      batch.positions[k] = points.positions.positions[batch.order[k]];
    }
    batch.normals.resize(count);
    batch.tangents.resize(tangent[0].empty() ? 0 : count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = batch.order[k];
      batch.normals[k] =
          glm::normalize(Vec<3>(points.normal[0][i], points.normal[1][i], points.normal[2][i]));
      if (tangent[0].empty()) continue;
      batch.tangents[k] = unit_tangent({tangent[0][i], tangent[1][i], tangent[2][i]}, batch.normals[k]);
    }
    const SampleBuffer<3> batch_samples(samples.subspan(0, count));
    fill_with_zero(batch_samples.samples());
    for (SurfaceSum<Source>& sum : sums) sum.add(batch, batch_samples.samples());
    scatter(batch_samples.samples(), batch.order, samples);
  }
}

}  // namespace solidnoise
