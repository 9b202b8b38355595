#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Notes in the metadata of a part's grids the recipe of the whole, and what merge_parts() needs to know that
// all parts are there. The values stay as they are: what depends on all of the volume, such as the scale of
// densities, and rounding to 16 bits, comes when the parts are joined. `whole` and `part` are their
// topologies.
void note_part(const VolumeRecipe& recipe, const std::string& creator, const Topology& whole,
               const Topology& part, Volume& volume);

// Whether a file is a part, and what note_part() saw, by a checksum of its topology and values. Throws what
// read_grids() throws.
bool is_sound_part(const std::filesystem::path& path);

struct MergedVolume {
  VolumeRecipe recipe;
  std::optional<int> frame;  // of the files, where they have one
  std::optional<double> fps;
  Volume volume;  // the same as that of the recipe made whole, to the last bit
};

// Joins the parts of one volume, in any order. Throws std::runtime_error naming the file if one is no part,
// is not what note_part() saw (by a checksum of its topology and values), or is that of another volume, if
// parts overlap, or if any is missing; what read_grids() throws; Cancelled.
MergedVolume merge_parts(const std::vector<std::filesystem::path>& files, const std::string& creator,
                         Progress* progress = nullptr);

// Joins parts into a file without having all of the volume in memory: the same file, to the byte, as
// write_volume() of merge_parts(). `options` say where the file is not as the parts say: what may be there
// already, creator and progress. Memory holds the largest part, then a slab of values that is smaller; less
// than 100 bytes for each node of 128^3 voxels of each part; and, where densities are scaled by their
// columns, 8 bytes for each of these. The grids that are returned have all but their values. Throws as both
// do.
MergedVolume merge_parts_to_file(const std::vector<std::filesystem::path>& files,
                                 const std::filesystem::path& path, VdbWriteOptions options);
// Whether they may be joined so: files that went through a pipe lack what is needed to find nodes.
bool may_stream_parts(const std::vector<std::filesystem::path>& files);

}  // namespace solidnoise
