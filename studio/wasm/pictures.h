#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "solidnoise/core/field.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise::studio {

// A plan for the field of a grid in a box of voxels, without the files and the memory that a volume would
// take.
VolumePlan plan_in_box(const VolumeRecipe& grid, double voxel);

// 0 outside the ellipsoid that a recipe's shape is, where it is one.
FieldPtr within_shape(FieldPtr field, const VolumeRecipe& grid);

// The grid of a question at the question's "time", where it has one.
VolumeRecipe timed_grid(const Json& question);

// The plane of a question: {"origin": [x, y, z], "normal": ..., "up": ..., "width": 2, "columns": 256,
// "rows": 256}.
SlicePlane plane_of(const Json& plane);

// What the pixels of a plane have values of: as `vdbnoise slice` has them where it can slice the recipe,
// otherwise the field that the volume has, at points.
struct SliceSubject {
  std::vector<SliceField> plain;  // one for each channel; empty: `field`
  FieldPtr field;
  SlicePlane plane;
  std::optional<ExemplarModel> exemplar;  // of the colours of `plain`, where they are its
  Json shown;                             // what is known of the values: see make_slice()
};
// Made anew only where recipe, grid, time, plane or "draft" differ from the last question's.
const SliceSubject& subject_of(const Json& question);

}  // namespace solidnoise::studio
