#pragma once

#include "solidnoise/volume/slice/slice_field.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What a slice whose file is a .vdb is taken of: its grid's values, interpolated between voxels. Throws
// std::runtime_error.
SliceField make_grid_slice(const SliceRecipe& slice, Progress* progress);

// The same of a grid in memory, which messages call by the slice's file.
SliceField make_grid_slice(const SliceRecipe& slice, const openvdb::GridBase::ConstPtr& grid);

}  // namespace solidnoise
