#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Vertices that are near each other, by index.
using VertexBatch = std::vector<std::uint32_t>;

// Sorts vertices into batches of up to some thousand: those of each cube of a grid, of this side, > 0.
// Positions must be finite.
std::vector<VertexBatch> make_batches(std::span<const Vec<3>> positions, double cube);

}  // namespace solidnoise
