#pragma once

#include "solidnoise/core/image.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// A picture of a volume that is no density: of the slice through the middle of its active voxels, across the
// horizontal axis that a viewer looks along (z where y is up, y where z is up). Three channels,
// sRGB-encoded, 0 to 1; the longer side has 480 pixels, or one for each voxel where there are more.
//   curl, gradient    streaks along what of the vectors is in the slice (line integral convolution, Cabral
//                     and Leedom 1993), from blue to yellow by their length, to twice the root mean square
//   color             the colours, with the range's ends, or -3 and 3, at black and white
//   phase, intensity  the phase as a hue, the intensity as brightness, to white at 2
// Where there are no voxels it is black. Throws std::invalid_argument if the first output is a value, of
// which render_preview() makes a picture.
Image render_slice(const Volume& volume, const VolumeRecipe& recipe);

}  // namespace solidnoise
