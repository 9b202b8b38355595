#pragma once

#include "solidnoise/volume/modify/closest_point.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

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
