#pragma once

#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A fire's grids, of one transform.
struct FireGrids {
  openvdb::FloatGrid::ConstPtr density;      // of its smoke, extinction per world unit
  openvdb::FloatGrid::ConstPtr temperature;  // kelvin
  openvdb::FloatGrid::ConstPtr flame;        // 0 to 1, how much of it glows; null: wherever it is hot
};

// A picture of a fire or an explosion before black, from the place of render_preview(): what is hot glows as
// a black body does (its colour by Wien's law at three wavelengths, its light with the fourth power of the
// temperature), is dimmed by the smoke before it and lights the smoke around it; a weak sun shows the rest.
// Grey smoke; three channels, sRGB-encoded, 0 to 1. Progress counts rows of pixels. Throws
// std::invalid_argument as render_preview(); Cancelled.
Image render_fire(const FireGrids& fire, const PreviewOptions& options, Progress* progress = nullptr);

// A picture of smoke: as render_preview(), of grey matter before an overcast sky.
Image render_smoke(const openvdb::FloatGrid& density, const PreviewOptions& options,
                   Progress* progress = nullptr);

// A picture of a density that glows before black: blue where it is thin, over rose to a pale gold where it is
// dense, each part dimmed by what is before it, blue light most. Otherwise as render_preview().
Image render_nebula(const openvdb::FloatGrid& density, const PreviewOptions& options,
                    Progress* progress = nullptr);

}  // namespace solidnoise
