#include "solidnoise/volume/recipe_field.h"

namespace solidnoise {

RecipeField::RecipeField(const VolumeRecipe& recipe, const std::string& grid, Progress* progress)
    : recipe_(recipe) {
  recipe.validate();
  if (!grid.empty()) require_grid(recipe, grid);
  single_ = recipe_of_grid(recipe, grid);
  if (!recipe.grids.empty()) recipe_.grids = {recipe.grids[entry_of_grid(recipe, grid)]};
  plan_ = plan_volume(recipe_, {}, progress);
}

VolumeField RecipeField::on_voxels(const GridFrame& frame, bool interpolated) const {
  VolumePlan plan = plan_;
  plan.frame = frame;
  VolumeRecipe recipe = recipe_;
  recipe.exact = recipe.exact || !interpolated;
  return make_volume_field(recipe, plan);
}

double RecipeField::highest_frequency(const GridFrame& frame) const {
  return solidnoise::highest_frequency(at_resolution(single_, frame.voxel_size()), plan_);
}

}  // namespace solidnoise
