#pragma once

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A level set of the zeros of `values`, in a band as wide as the background of that, in its frame. Cubic
// voxels; any values that have a slope at their zeros, active at least two voxels (to faces and edges) around
// each voxel that has one of the other side beside it, and everywhere of the right sign.
//
// Each voxel takes the distance to its closest point, found as by ClosestPointFinder, layer by layer from the
// zeros on; OpenVDB's LevelSetTracker then makes |gradient| 1 where that cannot be, around details of the
// size of a voxel. In parallel; the same to the last bit for any number of threads. Throws Cancelled.
openvdb::FloatGrid::Ptr measure_distances(const openvdb::FloatGrid& values, Progress* progress);

}  // namespace solidnoise
