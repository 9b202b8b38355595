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

// A grid's values, interpolated; of vectors what value_of(vector) makes of them.
template <typename Grid, typename ValueOf>
class GridField final : public PointwiseField {
 public:
  GridField(typename Grid::ConstPtr grid, ValueOf value_of)
      : grid_(std::move(grid)), value_of_(std::move(value_of)) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    const auto accessor = grid_->getConstAccessor();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3>& p = points.positions[i];
      const openvdb::Vec3d world(p.x, p.y, p.z);
      samples.values[i] = value_of_(openvdb::tools::BoxSampler::sample(accessor, grid_->worldToIndex(world)));
    }
  }

 private:
  typename Grid::ConstPtr grid_;
  ValueOf value_of_;
};

template <typename Grid, typename ValueOf>
SliceField make_grid_field(const typename Grid::ConstPtr& grid, const ValueOf& value_of) {
  return {make_slice_source(std::make_shared<GridField<Grid, ValueOf>>(grid, value_of)), 0.0, 0.0,
          world_bounds(*grid)};
}

// A component of a grid of vectors, or all three.
template <typename Grid>
std::vector<SliceField> make_vector_fields(const typename Grid::ConstPtr& grid,
                                           std::optional<SliceRecipe::Component> component) {
  using Vector = typename Grid::ValueType;
  if (component == SliceRecipe::Component::length) {
    const auto length = [](const Vector& vector) { return static_cast<float>(vector.length()); };
    return {make_grid_field<Grid>(grid, length)};
  }
  std::vector<SliceField> fields;
  for (int axis = 0; axis < 3; ++axis) {
    if (component && axis != static_cast<int>(*component)) continue;
    const auto at_axis = [axis](const Vector& vector) { return static_cast<float>(vector[axis]); };
    fields.push_back(make_grid_field<Grid>(grid, at_axis));
  }
  return fields;
}

template <typename Grid>
std::vector<SliceField> make_grid_fields(const SliceRecipe& slice, const typename Grid::ConstPtr& grid) {
  if constexpr (std::is_same_v<Grid, openvdb::FloatGrid>) {
    if (slice.component) {
      throw std::runtime_error(slice.file + ": is sliced at a grid of floats, which have no components");
    }
    require_finite_values(*grid, slice.file);
    return {make_grid_field<Grid>(grid, [](float value) { return value; })};
  } else {
    return make_vector_fields<Grid>(grid, slice.component);
  }
}

}  // namespace

std::vector<SliceField> make_grid_slices(const SliceRecipe& slice, Progress* progress) {
  return make_grid_slices(slice, read_float_or_vector_grid(slice.file, slice.grid, progress));
}

std::vector<SliceField> make_grid_slices(const SliceRecipe& slice, const openvdb::GridBase::ConstPtr& grid) {
  if (grid->activeVoxelCount() == 0) throw std::runtime_error(slice.file + ": no voxel of it is active");
  std::vector<SliceField> fields;
  const auto make = [&]<typename Grid>(const Grid& typed) {
    fields = make_grid_fields<Grid>(slice, openvdb::gridConstPtrCast<Grid>(grid));
    static_cast<void>(typed);
  };
  using Grids = openvdb::TypeList<openvdb::FloatGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid>;
  if (!as_file_error([&] { return grid->apply<Grids>(make); })) {
    throw std::runtime_error(fmt::format("{}: grid {} is of {}; it must be of float or vectors", slice.file,
                                         grid->getName(), grid->valueType()));
  }
  return fields;
}

}  // namespace solidnoise
