#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/field/curl_field.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Throws std::invalid_argument unless the grid is a level set whose voxels are cubes, without active tiles,
// in a frame that GridFrame takes.
void require_level_set(const openvdb::FloatGrid& grid);

// The distance to a surface by the cubic B-spline whose coefficients are the values of a level set.
//
// A spline of values, not through them: it is smoother than the level set by h^2/6 times the Laplacian, with
// h the size of a voxel. Its surface lies h^2 H / 3 inside that of the level set, H being the mean curvature
// (h^2 / (3 R) for a sphere of radius R), and the gradient's length differs from 1 by a part of the same
// order.
class DistanceSpline final : public SmoothDistance {
 public:
  // Known are all distances up to `reach` world units, > 0, on either side; a level set whose band is
  // narrower is rebuilt with a wider one (OpenVDB's levelSetRebuild, by way of polygons, which lie inside a
  // curved surface by another part of h^2 / R, about a half of it). Throws
  // std::invalid_argument as require_level_set does, and if the reach is more than 64 voxels.
  DistanceSpline(const openvdb::FloatGrid::ConstPtr& level_set, double reach);

  double reach() const override { return reach_; }
  void evaluate(std::span<const Vec<3>> positions, std::span<Jet> jets) const override;

 private:
  Jet at(const Vec<3>& position, const openvdb::FloatGrid::ConstAccessor& values) const;

  double reach_;
  openvdb::FloatGrid::ConstPtr level_set_;
  GridFrame frame_;
};

// The distance to a surface that is known to be needed before it is: what it takes can be told, and refused,
// before the band is widened.
class PlannedDistance {
 public:
  // Throws what DistanceSpline does.
  PlannedDistance(openvdb::FloatGrid::ConstPtr level_set, double reach);

  // Bytes that it takes at most, while the band is widened, and seconds of one core: by how much wider it is.
  std::uint64_t memory() const { return memory_; }
  double seconds() const { return seconds_; }

  // Made when it is first asked for, which no task may be that others wait for.
  std::shared_ptr<const DistanceSpline> distance() const;

 private:
  openvdb::FloatGrid::ConstPtr level_set_;
  double reach_;
  std::uint64_t memory_ = 0;
  double seconds_ = 0.0;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const DistanceSpline> distance_;
};

}  // namespace solidnoise
