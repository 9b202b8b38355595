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

}  // namespace solidnoise
