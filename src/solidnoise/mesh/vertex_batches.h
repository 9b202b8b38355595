#pragma once

#include <functional>

#include "solidnoise/core/points.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/mesh/bake_noise.h"

namespace solidnoise {

// Calls use(points) for all vertices, those of each cube of a grid of side `cube` > 0 (world
// units) together, some thousand at most, in parallel. The points' `vertices` say which they are.
void for_each_batch(const BakeVertices& vertices, double cube, Progress* progress,
                    const std::function<void(const Points<3>&)>& use);

}  // namespace solidnoise
