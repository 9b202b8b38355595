#pragma once

#include <optional>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The values of a block from the middle of a grid, of which all voxels are active: as large as the grid
// allows, and `longest_side` voxels at most. None where it would be under 8 voxels wide, too little to
// measure a spectrum.
std::optional<DenseField<3>> dense_block(const openvdb::FloatGrid& grid, int longest_side);

}  // namespace solidnoise
