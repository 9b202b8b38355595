#pragma once

#include <filesystem>
#include <optional>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The density of a grid whose values are not in memory all at once: scaled, and what is below its least left
// out, as finish_volume() does of a whole one, to the last bit. First look() at all of its slabs, in tree
// order, then settle().
class SlabDensity {
 public:
  // `single` is the short form that the density is of; all voxels lie within `bounds`.
  SlabDensity(const VolumeRecipe& single, const openvdb::CoordBBox& bounds);

  // Whether anything is to be looked for.
  bool has_unknowns() const { return !factor_ || prune_ > 0.0; }
  bool prunes() const { return prune_ > 0.0; }
  void look(const openvdb::FloatGrid& slab, double largest);
  void settle(const openvdb::math::Transform& transform);

  double factor() const { return factor_.value_or(1.0); }
  void scale(openvdb::FloatGrid& slab) const;
  void prune(openvdb::FloatGrid& slab) const;

 private:
  DensityScale scale_;
  int axis_;
  double prune_;
  std::optional<double> factor_;
  std::optional<ColumnSums> columns_{};  // until it is settled, where there is no factor
  double peak_ = 0.0;                    // before it is scaled
  float least_ = 0.0f;
};

// What is to be done with a slab of a grid's values, of any kind, before it is written: gives it what
// require_storable() asks for, which throws, and notes its statistics in the grid that it is of.
void finish_slab(const std::filesystem::path& path, const VolumeRecipe& recipe, const OutputGrid& output,
                 openvdb::GridBase& slab, MeasuredGrid& whole);

}  // namespace solidnoise
