#pragma once

#include <vector>

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

}  // namespace solidnoise
