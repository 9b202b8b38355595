#include "solidnoise/volume/slice/noise_slice.h"

#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "solidnoise/field/normalization.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// A noise of the plane, evaluated on a lattice of the pixels' middles, whose first sample is that of pixel
// (0, 0), normalized, and mapped to the range.
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

const RawShaping& raw_of(const VolumeRecipe& recipe) {
  return std::get<RawShaping>(recipe.shaping);
}

NoiseSlice slice_of(const VolumeRecipe& recipe, SliceSourcePtr source, double variance) {
  const double sigma = std::sqrt(variance);
  switch (raw_of(recipe).range) {
    case RawShaping::Range::raw:
      break;
    case RawShaping::Range::signed_values:
      return {std::move(source), sigma, {-1.0, 1.0}};
    case RawShaping::Range::unit:
      return {std::move(source), sigma, {0.0, 1.0}};
  }
  return {std::move(source), sigma, {-3.0 * sigma, 3.0 * sigma}};
}

// The noise of the plane as it is quickest on the pixels, if that is not pixel by pixel.
SliceSourcePtr interpolated_source(const VolumeRecipe& recipe, const SlicePlane& plane,
                                   const std::shared_ptr<const Noise<2>>& noise,
                                   const Normalization& normalization, const Vec<2>& first_pixel) {
  if (recipe.exact) return nullptr;
  LatticeFrame<2> frame{first_pixel, Vec<2>(plane.pixel)};
  for (const auto& [axis, direction] : {std::pair(0, plane.right), std::pair(1, plane.up)}) {
    frame.period[axis] = whole_period(period_along(direction, recipe.noise), frame.step[axis]);
  }
  const auto interpolated = interpolate<2>(noise, frame, ErrorBudget(error_of(recipe.noise)).interpolation);
  if (interpolated == noise) return nullptr;
  return std::make_shared<LatticeSource>(interpolated, frame, normalization, raw_of(recipe).range);
}

SliceSourcePtr source_at_points(const VolumeRecipe& recipe, FieldPtr noise,
                                const Normalization& normalization) {
  return make_slice_source(shape(map_field(std::move(noise), normalization), raw_of(recipe)));
}

// As normalization_of() has it in space.
template <int Dim>
Normalization flat_normalization(const VolumeRecipe& recipe, const Noise<Dim>& noise) {
  if (!raw_of(recipe).normalize) return {};
  return normalization_in<Dim>(noise, {Vec<Dim>(recipe.box.lower), Vec<Dim>(recipe.box.upper)},
                               period_of(recipe.noise));
}

template <int Dim>
NoiseSlice make_flat(const VolumeRecipe& recipe, const SlicePlane& plane) {
  Vec<Dim> offset;
  for (int axis = 0; axis < Dim; ++axis) offset[axis] = moved(recipe)[axis];
  const std::shared_ptr<const Noise<Dim>> noise =
      move_noise<Dim>(make_noise<Dim>(at_time(recipe.noise, recipe.time)), offset);
  const Normalization normalization = flat_normalization<Dim>(recipe, *noise);
  SliceSourcePtr source;
  if constexpr (Dim == 2) {
    if (plane.right == Vec<3>(1.0, 0.0, 0.0) && plane.up == Vec<3>(0.0, 1.0, 0.0)) {
      source = interpolated_source(recipe, plane, noise, normalization, Vec<2>(plane.position(0, 0)));
    }
  }
  if (!source) {
    source = source_at_points(recipe, std::make_shared<FlatNoiseField<Dim>>(noise), normalization);
  }
  return slice_of(recipe, source, noise->variance());
}

}  // namespace

double variance_of(const VolumeRecipe& recipe, const NoiseSlice& slice) {
  return raw_of(recipe).normalize ? 1.0 : slice.sigma * slice.sigma;
}

bool is_noise_alone(const VolumeRecipe& recipe) {
  return std::holds_alternative<RawShaping>(recipe.shaping) && recipe.layers.empty() && !recipe.within &&
         !recipe.parameters.any() && std::holds_alternative<BoxShape>(recipe.shape) &&
         (is_scalar(recipe) || recipe.output == std::vector{Output::color});
}

NoiseSlice make_noise_slice(const VolumeRecipe& recipe, const SlicePlane& plane) {
  const std::shared_ptr<const Noise<3>> noise = make_volume_noise(recipe);
  const Normalization normalization = normalization_of(recipe, recipe.box);
  SliceSourcePtr source =
      interpolated_source(recipe, plane, on_plane(noise, {plane.position(0, 0), plane.right, plane.up}),
                          normalization, Vec<2>(0.0));
  if (!source) source = source_at_points(recipe, noise, normalization);
  return slice_of(recipe, source, noise->variance());
}

NoiseSlice make_flat_slice(const VolumeRecipe& recipe, const SlicePlane& plane) {
  return recipe.dims == 1 ? make_flat<1>(recipe, plane) : make_flat<2>(recipe, plane);
}

double highest_frequency_in_slice(const VolumeRecipe& recipe) {
  if (recipe.dims == 1) return make_noise<1>(recipe.noise)->band().upper;
  if (recipe.dims == 2) return make_noise<2>(recipe.noise)->band().upper;
  return highest_frequency(recipe, {});
}

double period_along(const Vec<3>& direction, const NoiseRecipe& noise) {
  const Vec<4> period = period_of(noise);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) == 1.0) return period[axis];
  }
  return 0.0;
}

}  // namespace solidnoise
