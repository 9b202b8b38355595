#pragma once

#include <span>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Finds the points of a surface that are closest to voxels, in index space: of a level set, or of the zeros
// of a grid whose values have a slope there, of no less than a half. Voxels must be cubes. One per thread.
class ClosestPointFinder {
 public:
  explicit ClosestPointFinder(const openvdb::FloatGrid& surface);

  struct Guess {
    openvdb::Vec3d point;   // x - phi(x) grad phi(x) / |grad phi(x)|
    double distance = 0.0;  // phi(x), voxels
  };
  // By the values at the voxel and its six neighbours alone; of a level set.
  Guess guess(const openvdb::Coord& voxel) const;

  struct Foot {
    openvdb::Vec3d point;   // on the surface
    double distance = 0.0;  // from the voxel to it, negative inside, voxels
  };
  // Improves a guess until the way from the voxel to the point is the surface's normal there:
  //   p <- p + d t,   t = (x - p) - ((x - p) . n) n,   p <- p - n phi(p) / |grad phi(p)|,
  // with phi and its gradient (central differences) interpolated trilinearly, n = grad phi / |grad phi|, and
  // d < 1. Where that leads away from the guess, the guess is what is returned.
  Foot find(const openvdb::Coord& voxel, const Guess& guess) const;

 private:
  struct Sample {
    double value = 0.0;  // over the slope, voxels
    openvdb::Vec3d normal;
  };
  Sample sample(const openvdb::Vec3d& point) const;
  void read_row(const openvdb::Coord& first, std::span<double> row) const;  // along z

  openvdb::FloatGrid::ConstAccessor values_;
  double per_voxel_;
};

// Looks for the closest points of a surface where its distances are not known yet, from voxels beside those
// where they are: layer by layer, away from the surface. One per thread.
class DistanceFront {
 public:
  // The surface are the zeros of `surface`, which has cubic voxels and the right sign everywhere. Distances
  // (world units) are known where `known` is active but for the voxels of `layer`, those that are looked at
  // now.
  struct Grids {
    const openvdb::FloatGrid& surface;
    const openvdb::FloatGrid& known;
    const openvdb::MaskTree& layer;
  };
  explicit DistanceFront(const Grids& grids);

  // Of a voxel of the layer. It begins at what the eikonal equation |grad s| = 1 makes of the nearest known
  // neighbour on each axis: the sum of (s - s_i)^2 over the axes that make s larger than all of their s_i is
  // 1 (Sethian 1996, the upwind scheme of fast marching), which is of first order; and improves that.
  ClosestPointFinder::Foot find(const openvdb::Coord& voxel) const;

 private:
  ClosestPointFinder::Guess guess(const openvdb::Coord& voxel) const;

  ClosestPointFinder finder_;
  openvdb::FloatGrid::ConstAccessor surface_;
  openvdb::FloatGrid::ConstAccessor known_;
  openvdb::tree::ValueAccessor<const openvdb::MaskTree> layer_;
  double per_voxel_;
};

}  // namespace solidnoise
