#pragma once

#include <optional>

#include "commands.h"
#include "solidnoise/core/field.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/slice/noise_slice.h"

namespace solidnoise::studio {

// A plan for the field of a grid in a box of voxels, without the files and the memory that a volume would
// take.
VolumePlan plan_in_box(const VolumeRecipe& grid, double voxel);

// The field that the voxels of a plan have, 0 outside the recipe's shape.
FieldPtr field_in_shape(const VolumeRecipe& grid, const VolumePlan& plan);

// The grid of a question at the question's "time", where it has one.
VolumeRecipe timed_grid(const Json& question);

// The plane of a question: {"origin": [x, y, z], "normal": ..., "up": ..., "width": 2, "columns": 256,
// "rows": 256}.
SlicePlane plane_of(const Json& plane);

// What the pixels of a plane have values of, as `vdbnoise slice` has them.
struct SliceSubject {
  SliceSourcePtr source;
  SlicePlane plane;
  double sigma = 0.0;                     // of a noise alone
  std::optional<ChannelColors> color_of;  // by an exemplar, whose channels the source has
  Json shown;                             // what is known of the values: see make_slice()
};
// Made anew only where recipe, grid, time, plane or "draft" differ from the last question's.
const SliceSubject& subject_of(const Json& question);

}  // namespace solidnoise::studio
