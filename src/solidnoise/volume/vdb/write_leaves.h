#pragma once

#include <ostream>
#include <span>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Writes the values of leaves of floats or of vectors as OpenVDB does, to the same bytes, but compresses many
// leaves at once (tbb::global_control sets the threads). `grid` says whether they are stored as 16-bit
// floats.
template <typename Leaf>
void write_leaves(std::ostream& stream, std::span<const Leaf* const> leaves, const openvdb::GridBase& grid);

}  // namespace solidnoise
