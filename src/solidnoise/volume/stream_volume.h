#pragma once

#include <cstddef>
#include <filesystem>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/vdb/streamed_grid.h"

namespace solidnoise {

// Whether stream_volume() can make a plan's volume: a whole one that modifies no other.
bool may_stream(const VolumePlan& plan);

// How many times the voxels are evaluated then: once for each grid, as files have one behind the other; once
// more where voxels of 0 are left out or densities scaled, which is to be known before the first value is
// written; and again where densities below a part of the largest one are left out.
int passes_of_stream(const VolumeRecipe& recipe);

// Makes a volume slab by slab as it is written, for which memory need not hold its values: the same file, to
// the byte, as by make_volume() and write_volume(). The file is to be one that can seek, not "-". The grids
// that are returned have all but their values. Throws what those two do; the options' progress is told of
// the voxels.
Volume stream_volume(const std::filesystem::path& path, const VolumeRecipe& recipe, const VolumePlan& plan,
                     const VdbWriteOptions& options, std::size_t slab_bytes = kSlabBytes);

}  // namespace solidnoise
