#include "solidnoise/volume/volume.h"

#include <fmt/format.h>

#include "solidnoise/core/named_error.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {

void require_storable(const std::filesystem::path& path, const openvdb::GridBase& grid) {
  as_file_error([&] {
    require_finite_values(grid, fmt::format("{}: not written: grid '{}'", path.string(), grid.getName()));
  });
}

openvdb::GridCPtrVec grids_of(const Volume& volume) {
  if (volume.file) return {volume.file->grids.begin(), volume.file->grids.end()};
  openvdb::GridCPtrVec grids;
  for (const MeasuredGrid& measured : volume.grids) grids.push_back(measured.grid);
  return grids;
}

void write_volume(const std::filesystem::path& path, const Volume& volume, const VdbWriteOptions& options) {
  VdbWriteOptions write = options;
  if (volume.file) {
    // What the file said of itself stays, its maker included.
    write.metadata = volume.file->metadata;
    if (write.metadata["creator"]) write.creator.clear();
  }
  const openvdb::GridCPtrVec grids = grids_of(volume);
  for (const auto& grid : grids) require_storable(path, *grid);
  write_vdb(path, grids, write);
}

std::vector<double> write_nvdb(const std::filesystem::path& path, const Volume& volume,
                               const NvdbWriteOptions& options) {
  const openvdb::GridCPtrVec grids = grids_of(volume);
  for (const auto& grid : grids) require_storable(path, *grid);
  return write_nvdb(path, grids, options);
}

}  // namespace solidnoise
