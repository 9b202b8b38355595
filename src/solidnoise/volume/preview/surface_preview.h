#pragma once

#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A picture of a level set: its surface, matt and light grey, under the sun and sky of render_preview() and
// seen from the same place, with the sun's shadows. Rays are OpenVDB's LevelSetRayIntersector's, four to a
// pixel. In parallel. Three channels, sRGB-encoded, 0 to 1. Progress counts rows of pixels. Throws
// std::invalid_argument if an option is out of range, the grid is no level set or its voxels are not cubes;
// Cancelled.
Image render_surface(const openvdb::FloatGrid& level_set, const PreviewOptions& options,
                     Progress* progress = nullptr);

}  // namespace solidnoise
