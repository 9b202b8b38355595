#pragma once

#include <optional>
#include <string>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/plan_volume.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Makes the volume, in parallel, from the plan of the same recipe, and finishes it (finish_volume()); a part
// of it is for merge_parts(). `creator`, such as "vdbnoise 0.1.0", goes into the metadata. Throws
// std::invalid_argument, Cancelled.
Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress = nullptr);

// Whether a short form's densities are scaled by something that is to be measured.
bool measures_density(const VolumeRecipe& recipe);

// What make_volume() multiplies the densities of a short form by, measured on the whole of the volume,
// whatever part the plan is of; nothing where all of it is 0. Of a sequence it is measured once, at the
// recipe's own time, and becomes DensityScale::factor, so that frames and parts of frames have one scale
// wherever they are made. The volume is made slab by slab, so that it takes no more memory than a part. Not
// for raw noise. Throws as make_volume().
std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const VolumePlan& plan,
                                             Progress* progress = nullptr);

}  // namespace solidnoise
