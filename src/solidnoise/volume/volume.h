#pragma once

#include <optional>
#include <vector>

#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {

// Grids of the same active voxels, named, with their classes and metadata.
struct Volume {
  std::vector<MeasuredGrid> grids;  // at least one
  std::optional<VdbFile> file{};    // where a grid was modified: all of its file, with what became of it
};

}  // namespace solidnoise
