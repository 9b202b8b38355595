#pragma once

#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/image/color.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What a volume is shown as that is not looked through.
struct SolidLook {
  // Of the values: colours of `least` to `most`.
  ColorRamp ramp;
  float least = 0.0f;
  float most = 1.0f;
  bool is_cut = false;  // without the eighth that is nearest to the viewer, so that its inside is seen
  bool is_polished = false;
};

// A picture of a body as it would be cut from a block of solid noise: its surface has the colours of `values`
// there, under a sun and a sky, before grey, from the place of render_preview(). The body is where `body` is
// over half of its largest value, or if that is null the active voxels of `values`; both have one transform.
// Three channels, sRGB-encoded, 0 to 1. Progress counts rows of pixels. Throws std::invalid_argument as
// render_preview(); Cancelled.
Image render_solid(const openvdb::FloatGrid& values, openvdb::FloatGrid::ConstPtr body, const SolidLook& look,
                   const PreviewOptions& options, Progress* progress = nullptr);

}  // namespace solidnoise
