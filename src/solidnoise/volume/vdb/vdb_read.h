#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What a .vdb says about one of its grids.
struct GridSummary {
  std::string name;
  std::string value_type;  // "float", "vec3s", ...
  std::string grid_class;  // "fog volume", "level set", "staggered", "unknown"
  std::string
      vector_type;  // of vectors: how a transform turns them, "covariant", "invariant", ...; else empty
  bool saved_as_half = false;
  Vec<3> voxel_size{0.0};  // world units
  std::uint64_t active_voxels = 0;
  openvdb::CoordBBox voxel_bounds;              // of the active voxels; empty if there are none
  std::map<std::string, std::string> metadata;  // all of it, as text
};

struct VdbSummary {
  std::map<std::string, std::string> metadata;  // the file's own
  std::vector<GridSummary> grids;               // in the file's order, at least one
};

// Whether a grid's values are floats (stored as half or not), or vectors, vec3s or vec3d.
bool has_floats(const openvdb::GridBase& grid);
bool has_vectors(const openvdb::GridBase& grid);

// Of .vdb, and of .nvdb (nvdb_reader.h). A path of "-" is the standard input. Each function throws
// std::runtime_error naming the path if the file cannot be read, is no .vdb, is damaged as far as that shows
// (values have no checksums), has voxels of indices beyond +-2^30, or holds no grids.

VdbSummary read_vdb_summary(const std::filesystem::path& path);

// Bytes of the grid in memory, as its file says, but no less than its active voxels have as floats.
double memory_of(const GridSummary& grid);

// All of the grid of this name, or, if `name` is empty, of the first one. Throws std::runtime_error listing
// the names that exist if there is none.
openvdb::GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& name = {},
                                 Progress* progress = nullptr);

// As read_grid, of a grid of floats (stored as half or not); `name` empty: the first of them. Throws
// std::runtime_error also if the named grid is of another type.
openvdb::FloatGrid::Ptr read_float_grid(const std::filesystem::path& path, const std::string& name = {},
                                        Progress* progress = nullptr);

// As read_float_grid, of a grid of vectors, vec3s or vec3d.
openvdb::GridBase::Ptr read_vector_grid(const std::filesystem::path& path, const std::string& name = {},
                                        Progress* progress = nullptr);

// As read_float_grid, of a grid of floats or of vectors.
openvdb::GridBase::Ptr read_float_or_vector_grid(const std::filesystem::path& path,
                                                 const std::string& name = {}, Progress* progress = nullptr);

// All grids of a file, in its order, and the file's own metadata. Grids that share a tree in the file share
// it here. What the file says of a grid's place in it (bounds, sizes, compression) is left out: the next file
// has its own.
struct VdbFile {
  openvdb::MetaMap metadata;
  openvdb::GridPtrVec grids;  // at least one
};
VdbFile read_grids(const std::filesystem::path& path, Progress* progress = nullptr);

// The place among a file's grids of the one of floats with this name, or of the first if it is empty. Throws
// std::runtime_error as read_float_grid.
std::size_t find_float_grid(const std::filesystem::path& path, const VdbFile& file, const std::string& name);

}  // namespace solidnoise
