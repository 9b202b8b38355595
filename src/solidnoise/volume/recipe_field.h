#pragma once

#include <string>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/volume_field.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What the voxels of one of a recipe's grids are filled with, anywhere: without the recipe's shape, and what
// its values are scaled to. Immutable; may be shared between threads.
class RecipeField {
 public:
  // Of the grid of a name; empty: of the first one. Reads the files that the recipe names. Throws as
  // require_grid() and plan_volume().
  explicit RecipeField(const VolumeRecipe& recipe, const std::string& grid = {},
                       Progress* progress = nullptr);

  // The short form of the grid.
  const VolumeRecipe& single() const { return single_; }

  // The field as it is on the voxels of a frame, on whose size noises with band_limit depend and, but at
  // points, the edges of clouds. Where it is `interpolated`, that is within the recipe's error, on these
  // voxels.
  VolumeField on_voxels(const GridFrame& frame, bool interpolated = false) const;

  // The frame of the recipe's own voxels.
  const GridFrame& frame() const { return plan_.frame; }

  // As highest_frequency() has it of the recipe, on the voxels of a frame.
  double highest_frequency(const GridFrame& frame) const;

 private:
  VolumeRecipe recipe_;  // with the grid alone
  VolumeRecipe single_;
  VolumePlan plan_;
};

}  // namespace solidnoise
