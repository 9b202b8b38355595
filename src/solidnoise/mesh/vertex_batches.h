#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Vertices that are near each other, by index. Their positions are to be given as single-precision offsets
// from `origin`, a corner of a grid of cubes that is fixed in space: what rounding does to a position then
// depends on the position alone.
struct VertexBatch {
  Vec<3> origin{0.0};
  std::vector<std::uint32_t> vertices;
};

// Sorts vertices into batches of up to some thousand. `cube` is the side of the cubes, > 0. Positions must be
// finite.
std::vector<VertexBatch> make_batches(std::span<const Vec<3>> positions, double cube);

}  // namespace solidnoise
