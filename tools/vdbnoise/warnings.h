#pragma once

#include <iosfwd>

#include "solidnoise/volume/make_volume.h"

namespace solidnoise {

// Writes a line where the voxels do not suit the noise: they cannot hold its frequencies, or its period is
// not a whole number of them; or where a velocity has divergence that they can see.
void warn_of_resolution(const VolumeRecipe& recipe, const VolumePlan& plan, std::ostream& stream);

}  // namespace solidnoise
