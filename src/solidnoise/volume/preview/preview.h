#pragma once

#include "solidnoise/core/choices.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

struct PreviewOptions {
  int width = 480;   // pixels; 16 to 8192
  int height = 480;  // pixels; 16 to 8192
  UpAxis up = UpAxis::y;
  // The grid whose active voxels frame the picture instead of those that are shown, so that frames of a
  // sequence or parts of a volume are seen from one place; null: none.
  openvdb::FloatGrid::ConstPtr frame{};
};

// A picture of a fog volume, its values taken as extinction per world unit: lit by a sun and a sky, before a
// blue background, seen at three quarters from a little above, framed by its active voxels or those of
// options.frame. In parallel. Three channels, sRGB-encoded, 0 to 1. A grid with nothing in it gives the
// background. Progress counts rows of pixels. Throws std::invalid_argument if an option is out of range or
// the grid's voxels are not cubes; Cancelled.
Image render_preview(const openvdb::FloatGrid& grid, const PreviewOptions& options,
                     Progress* progress = nullptr);

// A picture of a level set: its surface, matt and light grey, under the sun and sky of render_preview() and
// seen from the same place, with the sun's shadows. Rays are OpenVDB's LevelSetRayIntersector's, four to a
// pixel. In parallel. Three channels, sRGB-encoded, 0 to 1. Progress counts rows of pixels. Throws
// std::invalid_argument if an option is out of range, the grid is no level set or its voxels are not cubes;
// Cancelled.
Image render_surface(const openvdb::FloatGrid& level_set, const PreviewOptions& options,
                     Progress* progress = nullptr);

}  // namespace solidnoise
