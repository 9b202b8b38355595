#pragma once

#include <vector>

#include "solidnoise/volume/grid_sink.h"

namespace solidnoise {

// Grids of the same active voxels, named, with their classes and metadata.
struct Volume {
  std::vector<MeasuredGrid> grids;  // at least one
};

}  // namespace solidnoise
