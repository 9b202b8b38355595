#pragma once

#include <atomic>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "solidnoise/core/choices.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What the pictures of volumes have in common.

// A frame of reference for looking: x to the right, y up, z towards the camera.
struct View {
  openvdb::Vec3d right;
  openvdb::Vec3d up;
  openvdb::Vec3d back;
};

// At three quarters, from a little above.
View three_quarter_view(UpAxis axis);

openvdb::Vec3d vertical(UpAxis axis);
// Behind the viewer's left shoulder.
openvdb::Vec3d direction_to_sun(UpAxis axis);

// Where the camera of a picture is, which looks against view.back.
struct Camera {
  openvdb::Vec3d eye;
  double tan_x = 0.0;  // tangents of half the field of view
  double tan_y = 0.0;
};

// What the camera sees at a place of the picture, from 0 at its left and top to 1: a unit vector.
openvdb::Vec3d direction_at(const Camera& camera, const View& view, double x, double y);

// The grid that frames a picture of `shown`: that of the options, if it has one with active voxels.
const openvdb::FloatGrid& framing_grid(const openvdb::FloatGrid& shown, const PreviewOptions& options);

// One from which all active voxels of a grid, which has some, are in a picture of so many pixels, in the
// middle of it.
Camera frame_grid(const openvdb::FloatGrid& grid, const View& view, int width, int height);

// A clear sky in linear light, paler towards the horizon; `height` is 0 at the bottom of the picture and 1 at
// the top.
openvdb::Vec3d sky(double height);

// Linear light to display: highlights are rolled off above 0.6, then the sRGB curve (IEC 61966-2-1).
float encode_light(double linear);

// Throws std::invalid_argument for a picture of too few or too many pixels, or voxels that are not cubes.
void require_picture(const openvdb::FloatGrid& grid, const PreviewOptions& options);

// The picture whose rows painter.paint_row(y, image) fills, in parallel. Throws Cancelled.
template <typename Painter>
Image paint(const Painter& painter, const PreviewOptions& options, Progress* progress) {
  Image image(options.width, options.height, 3);
  std::atomic<std::uint64_t> rows_done{0};
  tbb::parallel_for(0, options.height, [&](int y) {
    throw_if_cancelled(progress);
    painter.paint_row(y, image);
    if (progress != nullptr) progress->advance(++rows_done, static_cast<std::uint64_t>(options.height));
  });
  return image;
}

}  // namespace solidnoise
