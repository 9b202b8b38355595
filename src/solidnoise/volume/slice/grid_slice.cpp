#include "solidnoise/volume/slice/grid_slice.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <openvdb/tools/Interpolation.h>

#include "solidnoise/core/named_error.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {
namespace {

// A grid's values, interpolated.
template <typename Grid>
class GridField final : public PointwiseField {
 public:
  explicit GridField(typename Grid::ConstPtr grid) : grid_(std::move(grid)) {}

  int channels() const override { return openvdb::VecTraits<typename Grid::ValueType>::Size; }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    const auto accessor = grid_->getConstAccessor();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3>& p = points.positions[i];
      const openvdb::Vec3d index = grid_->worldToIndex(openvdb::Vec3d(p.x, p.y, p.z));
      const auto value = openvdb::tools::BoxSampler::sample(accessor, index);
      if constexpr (openvdb::VecTraits<typename Grid::ValueType>::IsVec) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          samples.values[axis * points.size() + i] = static_cast<float>(value[static_cast<int>(axis)]);
        }
      } else {
        samples.values[i] = value;
      }
    }
  }

 private:
  typename Grid::ConstPtr grid_;
};

template <typename Grid>
SliceField make_grid_field(const SliceRecipe& slice, const typename Grid::ConstPtr& grid) {
  if constexpr (std::is_same_v<Grid, openvdb::FloatGrid>) {
    if (slice.component) {
      throw std::runtime_error(slice.file + ": is sliced at a grid of floats, which have no components");
    }
    require_finite_values(*grid, slice.file);
  }
  const auto field = std::make_shared<GridField<Grid>>(grid);
  SliceField result;
  result.source = make_slice_source(field, {0, field->channels(), slice.component});
  result.bounds = world_bounds(*grid);
  return result;
}

}  // namespace

SliceField make_grid_slice(const SliceRecipe& slice, Progress* progress) {
  return make_grid_slice(slice, read_float_or_vector_grid(slice.file, slice.grid, progress));
}

SliceField make_grid_slice(const SliceRecipe& slice, const openvdb::GridBase::ConstPtr& grid) {
  if (grid->activeVoxelCount() == 0) throw std::runtime_error(slice.file + ": no voxel of it is active");
  SliceField field;
  const auto make = [&]<typename Grid>(const Grid&) {
    field = make_grid_field<Grid>(slice, openvdb::gridConstPtrCast<Grid>(grid));
  };
  using Grids = openvdb::TypeList<openvdb::FloatGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid>;
  if (!as_file_error([&] { return grid->apply<Grids>(make); })) {
    throw std::runtime_error(fmt::format("{}: grid {} is of {}; it must be of float or vectors", slice.file,
                                         grid->getName(), grid->valueType()));
  }
  return field;
}

}  // namespace solidnoise
