#pragma once

#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The picture of a volume that suits its first grid: of a density, of a level set's surface, or of a slice of
// what is neither. `frame` is that of PreviewOptions; slices have none. Throws Cancelled.
Image picture_of(const Volume& volume, const VolumeRecipe& recipe, openvdb::FloatGrid::ConstPtr frame,
                 Progress* progress = nullptr);

// That of a part as the plan has it: in its place in the volume unless there is a frame, its densities as if
// they were all of it; their own scale they get when merged.
Image picture_of_part(const Volume& volume, const VolumeRecipe& recipe, const VolumePlan& plan,
                      openvdb::FloatGrid::ConstPtr frame, Progress* progress = nullptr);

}  // namespace solidnoise
