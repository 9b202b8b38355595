#pragma once

#include <cstdint>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Which voxels a grid is to have. The mask has leaves only, no active tiles, so that filling it is a loop
// over leaves.
struct Topology {
  GridFrame frame;
  openvdb::MaskTree::Ptr mask;

  std::uint64_t leaf_count() const;
  std::uint64_t voxel_count() const;
  openvdb::CoordBBox voxel_bounds() const;  // empty if there are no voxels
};

// All voxels of the box (see GridFrame::voxels_in). Throws std::invalid_argument if the box has none.
Topology box_topology(const GridFrame& frame, const Box<3>& box);

// The voxels whose centres lie within the ellipsoid or on it; `radii` along the axes in world units, > 0.
// Throws std::invalid_argument if there are none.
Topology ellipsoid_topology(const GridFrame& frame, const Vec<3>& centre, const Vec<3>& radii);
Topology sphere_topology(const GridFrame& frame, const Vec<3>& centre, double radius);

// The active voxels of a grid of any type, in the grid's own frame. Throws std::invalid_argument if it has
// none, or as GridFrame does.
Topology grid_topology(const openvdb::GridBase& grid);

// Bytes of memory that filling these voxels takes at most, when nothing is empty: leaves of floats for each
// channel, the mask, and what accompanies them. Known before the topology is made. For a mesh, take the
// voxels of its bounds.
std::uint64_t estimate_memory(const openvdb::CoordBBox& voxels, int channels = 1);
std::uint64_t estimate_memory(const Topology& topology, int channels = 1);
std::uint64_t estimate_memory(const openvdb::GridBase& grid, int channels = 1);  // for its active voxels

// Bytes that the same takes at most without any values: of the mask alone, while it is made.
std::uint64_t estimate_mask_memory(const openvdb::CoordBBox& voxels);
std::uint64_t estimate_mask_memory(const openvdb::GridBase& grid);

}  // namespace solidnoise
