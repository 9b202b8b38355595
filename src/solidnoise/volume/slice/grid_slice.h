#pragma once

#include <vector>

#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise {

// The fields of a slice whose file is a .vdb, one for each channel of the picture: its grid's values,
// interpolated between voxels. Apart from the noises', which need no OpenVDB. Throws std::runtime_error.
std::vector<SliceField> make_grid_slices(const SliceRecipe& slice);

}  // namespace solidnoise
