#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The mesh in index space, moved by whole leaves close to the origin, because meshToVolume computes in single
// precision.
struct IndexMesh {
  openvdb::Coord shift;  // what was taken off
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

// Throws std::invalid_argument if an index would leave +-2^30.
IndexMesh to_index_space(const GridFrame& frame, const TriangleMesh& mesh);

// The level set of a closed mesh (OpenVDB's meshToVolume): distances to its surface in world units, negative
// inside, up to `band` on both sides; beyond, the grid's background is band or -band. Far from the surface
// distances may be of a face next to the closest one, too large by a fraction of a voxel. Voxel centres are
// at multiples of the voxel size, in world units. Throws std::invalid_argument: as require_closed does, a
// voxel size that is not positive, a band of less than 3 voxels or more than 1000; Cancelled.
openvdb::FloatGrid::Ptr mesh_level_set(const TriangleMesh& mesh, double voxel, double band,
                                       Progress* progress = nullptr);

// Bytes that it takes at most. Throws std::invalid_argument for the voxel size and the band, as above.
std::uint64_t estimate_level_set_memory(const TriangleMesh& mesh, double voxel, double band);

}  // namespace solidnoise
