#pragma once

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A level set's surface after it moved, before its distances are what they should be.
struct MovedSurface {
  // Active close to where the surface is now, on both sides of it: there
  //   phi'(x) = s(x) - amount n(p(x)),
  // p(x) the closest point to voxel x of the surface as it was, s(x) the signed distance to it. Elsewhere
  // only the sign is meant.
  openvdb::FloatGrid::Ptr values;
  // Voxels that were on the way and whose closest point moved.
  openvdb::MaskTree::Ptr moved;
};

// Moves the zeros of `band`, a level set with cubic voxels, without active tiles and values past its
// background, by amount n (world units) along its normals. Begins at the surface and goes on from voxel to
// voxel until all of the moved surface is reached, so that the cost is that of the way, not of the longest
// one everywhere. Throws Cancelled.
MovedSurface move_surface(const openvdb::FloatGrid& band, const Field<3>& noise, double amount,
                          Progress* progress);

}  // namespace solidnoise
