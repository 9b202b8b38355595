#include "solidnoise/volume/slice/slice_field.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/volume/slice/grid_slice.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

class FieldSource final : public SliceSource {
 public:
  explicit FieldSource(FieldPtr field) : field_(std::move(field)) {}

  void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    std::vector<Vec<3>> positions;
    for (int column = first.x; column < first.x + count.x; ++column) {
      for (int row = first.y; row < first.y + count.y; ++row)
        positions.push_back(plane.position(column, row));
    }
    field_->evaluate({positions}, {values, {}});
  }

  int tile_side() const override { return 32; }

 private:
  FieldPtr field_;
};

class LatticeSource final : public SliceSource {
 public:
  LatticeSource(std::shared_ptr<const Noise<2>> noise, const LatticeFrame<2>& frame,
                const Normalization& normalization, RawShaping::Range range)
      : noise_(std::move(noise)), frame_(frame), normalization_(normalization), range_(range) {}

  void evaluate(const SlicePlane&, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    const Lattice<2> lattice{frame_.origin, frame_.step, Index<2>(first), count};
    noise_->block(lattice.bounds())->evaluate(lattice, Samples<2>{values, {}});
    for (float& value : values) value = normalization_(value);
    to_range(range_, values);
  }

  int tile_side() const override { return 128; }

 private:
  std::shared_ptr<const Noise<2>> noise_;
  LatticeFrame<2> frame_;
  Normalization normalization_;
  RawShaping::Range range_;
};

}  // namespace

std::unique_ptr<SliceSource> make_slice_source(FieldPtr field) {
  return std::make_unique<FieldSource>(std::move(field));
}

std::unique_ptr<SliceSource> make_slice_source(std::shared_ptr<const Noise<2>> noise,
                                               const LatticeFrame<2>& frame,
                                               const Normalization& normalization, RawShaping::Range range) {
  return std::make_unique<LatticeSource>(std::move(noise), frame, normalization, range);
}

namespace {

// A noise of fewer dimensions than space.
template <int Dim>
class FlatNoiseField final : public PointwiseField {
 public:
  explicit FlatNoiseField(std::shared_ptr<const Noise<Dim>> noise) : noise_(std::move(noise)) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    std::vector<Vec<Dim>> flat;
    flat.reserve(points.size());
    for (const Vec<3>& position : points.positions) {
      Vec<Dim>& of_flat = flat.emplace_back();
      for (int axis = 0; axis < Dim; ++axis) of_flat[axis] = position[axis];
    }
    noise_->evaluate(Points<Dim>{flat}, Samples<Dim>{samples.values, {}});
  }

 private:
  std::shared_ptr<const Noise<Dim>> noise_;
};

RawShaping::Range range_of(const VolumeRecipe& recipe) {
  return std::get<RawShaping>(recipe.shaping).range;
}

// The noise of the plane as it is quickest on the pixels, if that is not pixel by pixel.
std::shared_ptr<const SliceSource> interpolated_source(const SliceRecipe& slice, const VolumeRecipe& recipe,
                                                       const std::shared_ptr<const Noise<2>>& noise,
                                                       const Normalization& normalization,
                                                       const Vec<2>& first_pixel) {
  if (recipe.exact || slice.line) return nullptr;
  LatticeFrame<2> frame{first_pixel, Vec<2>(slice.plane.pixel)};
  for (const auto& [axis, direction] : {std::pair(0, slice.plane.right), std::pair(1, slice.plane.up)}) {
    frame.period[axis] = whole_period(period_along(direction, recipe.noise), frame.step[axis]);
  }
  const auto interpolated = interpolate<2>(noise, frame, ErrorBudget(error_of(recipe.noise)).interpolation);
  if (interpolated == noise) return nullptr;
  return make_slice_source(interpolated, frame, normalization, range_of(recipe));
}

// As normalization_of() has it in space.
template <int Dim>
Normalization flat_normalization(const VolumeRecipe& recipe, const Noise<Dim>& noise) {
  if (!std::get<RawShaping>(recipe.shaping).normalize) return {};
  return normalization_in<Dim>(noise, {Vec<Dim>(recipe.box.lower), Vec<Dim>(recipe.box.upper)},
                               period_of(recipe.noise));
}

template <int Dim>
SliceField make_flat_field(const SliceRecipe& slice, const VolumeRecipe& recipe) {
  Vec<Dim> offset;
  for (int axis = 0; axis < Dim; ++axis) offset[axis] = moved(recipe)[axis];
  const std::shared_ptr<const Noise<Dim>> noise =
      move_noise<Dim>(make_noise<Dim>(at_time(recipe.noise, recipe.time)), offset);
  SliceField result;
  result.sigma = std::sqrt(noise->variance());
  result.highest_frequency = noise->band().upper;
  const Normalization normalization = flat_normalization<Dim>(recipe, *noise);
  if constexpr (Dim == 2) {
    const SlicePlane& plane = slice.plane;
    if (plane.right == Vec<3>(1.0, 0.0, 0.0) && plane.up == Vec<3>(0.0, 1.0, 0.0)) {
      result.source = interpolated_source(slice, recipe, noise, normalization, Vec<2>(plane.position(0, 0)));
    }
  }
  if (!result.source) {
    const FieldPtr field = map_field(std::make_shared<FlatNoiseField<Dim>>(noise), normalization);
    result.source = make_slice_source(shape(field, std::get<RawShaping>(recipe.shaping)));
  }
  return result;
}

SliceField make_noise_field(const SliceRecipe& slice, const VolumeRecipe& recipe) {
  if (recipe.dims == 1) return make_flat_field<1>(slice, recipe);
  if (recipe.dims == 2) return make_flat_field<2>(slice, recipe);
  SliceField result;
  result.highest_frequency = highest_frequency(recipe, {});
  if (recipe.layers.empty()) {
    const std::shared_ptr<const Noise<3>> noise = make_volume_noise(recipe);
    const SlicePlane& plane = slice.plane;
    result.sigma = std::sqrt(noise->variance());
    result.source =
        interpolated_source(slice, recipe, on_plane(noise, {plane.position(0, 0), plane.right, plane.up}),
                            normalization_of(recipe, recipe.box), Vec<2>(0.0));
  }
  if (!result.source) result.source = make_slice_source(make_raw_field(recipe));
  return result;
}

}  // namespace

double period_along(const Vec<3>& direction, const NoiseRecipe& noise) {
  const Vec<4> period = period_of(noise);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) == 1.0) return period[axis];
  }
  return 0.0;
}

void require_sliceable(const VolumeRecipe& recipe) {
  const char* const more =
      !recipe.grids.empty() || !recipe.fields.empty()       ? "makes several grids, or has named fields"
      : !std::holds_alternative<RawShaping>(recipe.shaping) ? "shapes its noise"
      : !is_scalar(recipe) || recipe.modification || recipe.parameters.any() ? "is of more than a noise"
                                                                             : nullptr;
  if (more) throw std::invalid_argument(fmt::format("the recipe {}; slice the volume that it makes", more));
}

std::vector<SliceField> make_slice_fields(const SliceRecipe& slice, Progress* progress) {
  if (!slice.file.empty()) return make_grid_slices(slice, progress);
  require_sliceable(slice.recipe);
  const VolumeRecipe recipe = at_resolution(slice.recipe, Vec<3>(slice.plane.pixel));
  if (!slice.color) return {make_noise_field(slice, recipe)};
  std::vector<SliceField> channels;
  for (int channel = 0; channel < 3; ++channel) {
    VolumeRecipe of_channel = recipe;
    of_channel.noise = channel_of(recipe.noise, channel);
    channels.push_back(make_noise_field(slice, of_channel));
  }
  return channels;
}

}  // namespace solidnoise
