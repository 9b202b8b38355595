#pragma once

#include "digests/digest.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of floats or vectors: name, class, how vectors turn, precision, background, transform, tiles, leaves
// and the values of their active voxels; of a level set also those of the inactive ones, which say where the
// inside is. Other metadata may change. Throws std::invalid_argument for another type.
void add_grid(const openvdb::GridBase& grid, Digest& digest);

}  // namespace solidnoise
