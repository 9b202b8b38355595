#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/point/point_cluster.h"
#include "solidnoise/noise/point/point_tile.h"

namespace solidnoise {

// Writes the samples of some points, one after the other, to where the samples of all points are.
template <int Dim>
void scatter(const Samples<Dim>& some, std::span<const std::size_t> points, const Samples<Dim>& all) {
  for (std::size_t i = 0; i < points.size(); ++i) all.values[points[i]] = some.values[i];
  for (std::size_t axis = 0; all.wants_gradient() && axis < Dim; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) all.gradient[axis][points[i]] = some.gradient[axis][i];
  }
}

// Sums over impulses at points of one grid of cells, tile by tile. A source has these, and what is in them:
//   void gather(const PointTile<Dim>&, const PointCull&, ImpulseList&);  appends the impulses of a tile
//   void sum(std::span<const LocatedPoint<Dim>>, PointCluster&, ImpulseList&, ClusterSums&);  at a cluster of
//   points, of which it fills in what its kernel wants to know besides places, extents and normals
template <int Dim, typename Source>
class TiledSum {
 public:
  // `attributes` of an impulse.
  TiledSum(Source& source, const KernelExtent& extent, int attributes)
      : source_(source), extent_(extent), attributes_(attributes) {}

  // Adds the sum at each point, times its weight, to the sample that it is the number of; with a layer, the
  // part of its gradient that is along the surface. `cell`: its side, world units.
  void add(std::span<LocatedPoint<Dim>> points, double cell, const Samples<Dim>& samples) {
    per_unit_ = 1.0 / cell;
    cluster_.derivatives = derivatives_of(samples);
    while (!points.empty()) {
      const PointTile<Dim> tile(points);
      gathered_.clear();
      source_.gather(tile, bounds<Dim>(tile.points, extent_), gathered_);
      for (std::size_t first = 0; first < tile.points.size(); first += kPatchPoints) {
        add_patch(tile.points.subspan(first, std::min(kPatchPoints, tile.points.size() - first)), samples);
      }
    }
  }

 private:
  using Located = std::span<const LocatedPoint<Dim>>;

  void add_patch(Located points, const Samples<Dim>& samples) {
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
      add_cluster(cluster(i), samples);
    }
  }

  void add_cluster(Located points, const Samples<Dim>& samples) {
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
      if (point.radius == radius_[lane] && point.height == height_[lane]) continue;  // most often
      radius_[lane] = point.radius;
      height_[lane] = point.height;
      cluster_.inverse_square_radius[lane] = 1.0f / (point.radius * point.radius);
      cluster_.inverse_square_height[lane] = 1.0f / (point.height * point.height);
    }
    ClusterSums sums;
    source_.sum(points, cluster_, kept_, sums);
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[points[i].point] += points[i].weight * sums.value[i];
      if (samples.wants_gradient()) add_gradient(points[i], sums, i, samples);
    }
  }

  void add_gradient(const LocatedPoint<Dim>& point, const ClusterSums& sums, std::size_t lane,
                    const Samples<Dim>& samples) const {
    std::array<float, Dim> slope;
    for (int axis = 0; axis < Dim; ++axis) {
      slope[static_cast<std::size_t>(axis)] = sums.gradient[role_of_axis<Dim>(axis)][lane];
    }
    if constexpr (Dim == 3) {
      const float across =
          slope[0] * point.normal[0] + slope[1] * point.normal[1] + slope[2] * point.normal[2];
      for (std::size_t a = 0; extent_.layer > 0.0f && a < 3; ++a) slope[a] -= across * point.normal[a];
    }
    const auto weight = static_cast<float>(point.weight * per_unit_);
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      samples.gradient[axis][point.point] += weight * slope[axis];
    }
  }

  Source& source_;
  const KernelExtent& extent_;
  int attributes_;
  ImpulseList gathered_{Dim};  // of a tile
  ImpulseList near_{Dim};      // of a patch
  ImpulseList kept_{Dim};      // of a cluster
  PointCluster cluster_;
  double per_unit_ = 1.0;                               // cells
  std::array<float, PointCluster::kSamples> radius_{};  // that the cluster's extents are of
  std::array<float, PointCluster::kSamples> height_{};
};

}  // namespace solidnoise
