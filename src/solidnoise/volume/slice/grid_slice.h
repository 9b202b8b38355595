#pragma once

#include <vector>

#include "solidnoise/volume/slice/slice_field.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The fields of a slice whose file is a .vdb, one for each channel of the picture: its grid's values,
// interpolated between voxels. Apart from the noises', which need no OpenVDB. Throws std::runtime_error.
std::vector<SliceField> make_grid_slices(const SliceRecipe& slice, Progress* progress);

// The same of a grid in memory, which messages call by the slice's file.
std::vector<SliceField> make_grid_slices(const SliceRecipe& slice, const openvdb::GridBase::ConstPtr& grid);

}  // namespace solidnoise
