#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// How a .vdb stores a grid's tree.
struct VdbTreeFormat {
  std::string grid_type;          // as in the grid's descriptor, such as "Tree_float_5_4_3"
  bool half = false;              // real numbers are stored as half floats
  std::uint32_t compression = 0;  // openvdb::io's COMPRESS_ flags
};

// Where a .vdb has one of a tree's nodes of 128^3 voxels.
struct VdbNode {
  openvdb::Coord origin;
  std::uint64_t leaves = 0;
  std::int64_t topology = 0;  // positions in the file: of its masks and those of its leaves,
  std::int64_t values = 0;    // and of its leaves' values
};

// Walks over a tree in a .vdb (file versions 222 to 224), from where it begins to its end, and throws
// std::runtime_error if a chunk of values has not the size that its masks tell, or reaches past the end of
// the file, or if what the root has cannot be there. OpenVDB reads a chunk of any size that the file names
// into memory that has the size which the masks tell: a damaged file makes it write where it must not.
// Refuses grids other than those of bool, mask, int32, int64, float, double, vec3i, vec3s and vec3d, and
// trees other than OpenVDB's standard one. Returns the nodes that have leaves, in tree order; for bool and
// mask, whose leaves have no values, without their positions.
std::vector<VdbNode> check_vdb_tree(std::istream& stream, std::int64_t file_size,
                                    const VdbTreeFormat& format);

}  // namespace solidnoise
