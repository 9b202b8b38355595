#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/varying_field.h"
#include "solidnoise/mesh/bake_noise.h"

namespace solidnoise {

// Vectors' coordinates, axis by axis.
using Components = std::array<std::vector<float>, 3>;
Components components_of(std::span<const Vec<3>> vectors);

// Numbers that a mesh's vertices have, as a field of the points that are vertices (Points::vertices): one
// channel for each span. The numbers belong to somebody else. As a point's kernel is, they are held fixed by
// the gradient, which is 0. Throws std::invalid_argument where points are no vertices.
class VertexField final : public PointwiseField {
 public:
  explicit VertexField(std::vector<std::span<const float>> channels) : channels_(std::move(channels)) {}

  int channels() const override { return static_cast<int>(channels_.size()); }
  bool has_gradient() const override { return true; }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override;

 private:
  std::vector<std::span<const float>> channels_;
};

// The kernels of a noise on a surface: what holds everywhere, and what varies.
struct SurfaceKernel {
  double frequency = 8.0;  // principal frequency, cycles per world unit; > 0
  double bandwidth = 1.0;  // octaves
  KernelFields fields{};   // the direction is needed where has_direction(); of the others those that vary
  double filter = 0.0;     // BakeVertices::filter
  bool bounds_gradient = false;  // as NoiseRecipes may: bounding_gradient()
};

// The noise of a recipe as a field of points of a surface: of unit variance, or that of the octaves where
// they are not renormalised. Noises of the tangent plane throw std::invalid_argument where points have no
// normals. Their gradient is the part along the surface, with normal and kernel of the point held fixed; that
// of solid noises is the one in space. Throws std::invalid_argument: recipe.validate().
FieldPtr make_surface_field(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel);

// A noise of space as it is at the time of a noise on a surface, and of as many dimensions; convolved with a
// Gaussian of this deviation, world units, if it may_filter().
std::shared_ptr<const Noise<3>> solid_noise_of(const SurfaceNoiseRecipe& recipe, const NoiseRecipe& noise,
                                               double filter = 0.0);

// Whether a filter takes anything from a noise on a surface, and from one of space beside it: of Gabor noises
// and those by example, but not of slices of 4 dimensions, of which it would blur time.
bool may_filter(const SurfaceNoiseRecipe& recipe);
bool may_filter(const SurfaceNoiseRecipe& recipe, const NoiseRecipe& noise);

// The same as layers are made of it.
LayerNoise surface_layer_noise(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel);

// A kernel of `ratio` times the frequency, and one whose direction is turned by so many degrees in the
// tangent plane, against the clock as seen from outside.
SurfaceKernel scaled(const SurfaceKernel& kernel, double ratio);
SurfaceKernel turned(const SurfaceKernel& kernel, double degrees);

// Mean impulses that reach a point, of all octaves together; of noise without impulses 0.
double impulses_at_point(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel);

}  // namespace solidnoise
