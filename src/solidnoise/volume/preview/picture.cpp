#include "solidnoise/volume/preview/picture.h"

#include <utility>
#include <variant>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/preview/slice_preview.h"

namespace solidnoise {
namespace {

// All of the planned voxels, as they are before empty ones are dropped.
openvdb::FloatGrid::Ptr full_grid(const VolumePlan& plan) {
  const auto grid = openvdb::FloatGrid::create();
  grid->setTransform(plan.frame.transform());
  grid->sparseFill(plan.voxels, 1.0f);
  return grid;
}

}  // namespace

Image picture_of(const Volume& volume, const VolumeRecipe& recipe, openvdb::FloatGrid::ConstPtr frame,
                 Progress* progress) {
  const VolumeRecipe first = recipes_of_grids(recipe).front();
  if (first.output.front() != Output::value) return render_slice(volume, first);
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.front().grid);
  PreviewOptions options;
  options.up = recipe.up;
  options.frame = std::move(frame);
  const bool is_surface = density->getGridClass() == openvdb::GRID_LEVEL_SET;
  return is_surface ? render_surface(*density, options, progress)
                    : render_preview(*density, options, progress);
}

Image picture_of_part(const Volume& volume, const VolumeRecipe& recipe, const VolumePlan& plan,
                      openvdb::FloatGrid::ConstPtr frame, Progress* progress) {
  if (!frame) frame = full_grid(plan);
  const VolumeRecipe first = recipes_of_grids(recipe).front();
  if (std::holds_alternative<RawShaping>(first.shaping)) return picture_of(volume, recipe, frame, progress);
  MeasuredGrid shown = volume.grids.front();
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(shown.grid)->deepCopy();
  scale_density(first, *density, shown.moments.front());
  shown.grid = density;
  return picture_of({{shown}}, first, frame, progress);
}

}  // namespace solidnoise
