#pragma once

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

}  // namespace solidnoise
