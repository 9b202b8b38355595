#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"

namespace solidnoise {

// Grids of the same active voxels, named, with their classes and metadata.
struct Volume {
  std::vector<MeasuredGrid> grids;  // at least one
  std::optional<VdbFile> file{};    // where a grid was modified: all of its file, with what became of it
};

// All grids of a volume, with the rest of the file that one was modified in.
openvdb::GridCPtrVec grids_of(const Volume& volume);

// Writes all grids of a volume, with the rest of the file that one was modified in. Throws as write_vdb()
// does, and std::runtime_error naming the path where a value is not finite as it is stored.
void write_volume(const std::filesystem::path& path, const Volume& volume, const VdbWriteOptions& options);

// The same as NanoVDB: what write_nvdb() of the grids returns, and throws.
std::vector<double> write_nvdb(const std::filesystem::path& path, const Volume& volume,
                               const NvdbWriteOptions& options);

// What write_volume() refuses: throws std::runtime_error naming the path where a value of a grid is not
// finite as it is stored.
void require_storable(const std::filesystem::path& path, const openvdb::GridBase& grid);

}  // namespace solidnoise
