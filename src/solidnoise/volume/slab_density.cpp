#include "solidnoise/volume/slab_density.h"

#include <algorithm>

#include "solidnoise/volume/volume.h"

namespace solidnoise {

SlabDensity::SlabDensity(const VolumeRecipe& single, const openvdb::CoordBBox& bounds)
    : scale_(single.density),
      axis_(vertical_axis(single)),
      prune_(single.prune),
      factor_(single.density.factor) {
  if (!factor_ && !scale_.peak) columns_.emplace(bounds, axis_);
}

void SlabDensity::look(const openvdb::FloatGrid& slab, double largest) {
  peak_ = std::max(peak_, largest);
  if (columns_) columns_->add(slab);
}

void SlabDensity::settle(const openvdb::math::Transform& transform) {
  const double thickest = columns_ ? columns_->largest() * transform.voxelSize()[axis_] : 0.0;
  columns_.reset();
  if (!factor_) factor_ = density_factor(scale_, peak_, thickest);
  const float peak = static_cast<float>(peak_) * static_cast<float>(factor());
  least_ = static_cast<float>(prune_ * peak);
}

void SlabDensity::scale(openvdb::FloatGrid& slab) const {
  if (factor_) scale_values(slab, static_cast<float>(*factor_));
}

void SlabDensity::prune(openvdb::FloatGrid& slab) const {
  if (prune_ > 0.0) drop_below(least_, slab);
}

void finish_slab(const std::filesystem::path& path, const VolumeRecipe& recipe, const OutputGrid& output,
                 openvdb::GridBase& slab, MeasuredGrid& whole) {
  slab.setName(output.name);
  slab.setSaveFloatAsHalf(output.single.half);
  require_storable(path, slab);
  merge_moments(slab, whole.moments);
  note_recipe(recipe, whole.moments, *whole.grid);
}

}  // namespace solidnoise
