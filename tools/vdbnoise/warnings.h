#pragma once

#include <iosfwd>

#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Writes a line where the voxels do not suit the noise: they cannot hold its frequencies, or its period is
// not a whole number of them; or where a velocity has divergence that they can see.
void warn_of_resolution(const VolumeRecipe& recipe, const GridFrame& frame, std::ostream& stream);

}  // namespace solidnoise
