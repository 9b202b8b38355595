#pragma once

#include "solidnoise/core/cost.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The voxels whose centres lie inside a closed mesh, or no more than `outside` voxels off it (OpenVDB's
// meshToVolume), and the distances to its surface, in voxels, negative inside; beyond a band around it they
// are those at the band's ends. Needs a frame of cubic voxels. Throws std::invalid_argument as require_closed
// does, or if the mesh holds no voxel's centre; Cancelled.
struct MeshVoxels {
  Topology topology;
  openvdb::FloatGrid::ConstPtr distance;  // at the voxel of the index plus `shift`
  openvdb::Coord shift;
};
MeshVoxels mesh_voxels(const GridFrame& frame, const TriangleMesh& mesh, double outside,
                       Progress* progress = nullptr);

// The level set of a closed mesh (OpenVDB's meshToVolume): distances to its surface in world units, negative
// inside, up to `band` on both sides; beyond, the grid's background is band or -band. Far from the surface
// distances may be of a face next to the closest one, too large by a fraction of a voxel. Voxel centres are
// at multiples of the voxel size, in world units. Throws std::invalid_argument: as require_closed does, a
// voxel size that is not positive, a band of less than 3 voxels or more than 1000; Cancelled.
openvdb::FloatGrid::Ptr mesh_level_set(const TriangleMesh& mesh, double voxel, double band,
                                       Progress* progress = nullptr);

// What making and writing it takes at most, by one thread, with the program itself. Throws
// std::invalid_argument for the voxel size and the band, as above.
Cost level_set_cost(const TriangleMesh& mesh, double voxel, double band);

}  // namespace solidnoise
