#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {

// The noises that a surface can have, none of which needs a parametrisation.
enum class SurfaceNoiseKind {
  surface,        // Gabor noise of the tangent plane (SurfaceGaborNoise): a true two-dimensional band
  oriented,       // the same with waves that travel along a direction of the tangent plane
  solid,          // isotropic Gabor noise of space, the field that volumes have (GaborNoise<3>)
  kensler,        // gradient noise projected on the tangent plane (ProjectedGradientNoise)
  kensler_solid,  // gradient noise of space (GradientNoise<3>)
  spectrum,  // by example: in the tangent plane along a direction (SurfaceSpectrumNoise), or, of an exemplar
             // in three dimensions, the field of space (SpectrumNoise<3>)
};

// Everything that defines a noise on a surface but the frequency and what varies with the vertex: plain data.
struct SurfaceNoiseRecipe {
  SurfaceNoiseKind kind = SurfaceNoiseKind::surface;
  double error = 0.02;    // relative RMS error of Gabor kernels; 1e-4 to 0.5
  double impulses = 0.0;  // mean impulses under a Gabor kernel; 0: the fewest that look Gaussian
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  // Mean excess kurtosis that strata may leave, where impulses is 0; 0.02 to 0.5.
  double kurtosis = kMeanKurtosis;
  double layer = 0.5;  // of surface and oriented: half the layer's thickness, in kernel radii; 0.1 to 1
  FractalOptions fractal{};
  std::uint64_t seed = 0;
  ExemplarModel exemplar{};  // of spectrum
  int channel = 0;           // of the exemplar, that is baked; from 0
  // How it changes with time: impulses turn (Evolution), each frame having the noise's spectrum; or, of the
  // solid noises `solid` and `kensler_solid`, a frame is a slice of a noise of 4 dimensions.
  int dims = 3;         // 3 or 4
  double time = 0.0;    // of the frame
  double evolve = 0.0;  // Evolution::rate; 0: it does not evolve
  double loop = 0.0;    // units of time after which the noise repeats; 0: never

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  // Of the impulses.
  Evolution evolution() const { return {evolve, time, dims == 3 ? loop : 0.0}; }

  friend bool operator==(const SurfaceNoiseRecipe&, const SurfaceNoiseRecipe&) = default;
};

// Whether there is an error and a number of impulses; and also a bandwidth, which may then differ from vertex
// to vertex. Where the frequency does, kernels that have a bandwidth have every frequency, other noises are
// graded (make_graded_field).
bool is_gabor(SurfaceNoiseKind kind);
bool has_bandwidth(SurfaceNoiseKind kind);
// Whether impulses are taken from a layer around the surface.
bool has_layer(const SurfaceNoiseRecipe& recipe);
// Whether the noise lies in the tangent plane, and not in space.
bool has_plane(const SurfaceNoiseRecipe& recipe);
// Whether the noise lies along a direction of the tangent plane.
bool has_direction(const SurfaceNoiseRecipe& recipe);

// The noise of another channel of the exemplar, which is independent.
SurfaceNoiseRecipe channel_of(const SurfaceNoiseRecipe& recipe, int channel);

// A number that every vertex has: one for all, or one each.
struct VertexNumber {
  double constant = 0.0;
  std::vector<float> values{};  // empty: `constant` holds for all

  bool varies() const { return !values.empty(); }
};

// Where a noise is to be evaluated, and its parameters there.
struct BakeVertices {
  std::span<const Vec<3>> positions;  // rest positions, world units, finite
  std::span<const Vec<3>> normals;    // smooth; any length but 0
  VertexNumber frequency{8.0, {}};    // principal frequency, cycles per world unit; > 0
  VertexNumber bandwidth{1.0, {}};    // octaves; 0.1 to 4
  VertexNumber magnitude{1.0, {}};    // standard deviation of the value; >= 0
  // Where has_direction(); tangential or not, either sign. Waves of `oriented` are longer where they are
  // shorter than 1 (SurfaceGaborNoise).
  std::span<const Vec<3>> directions;
  VertexNumber bias{0.0, {}};        // added to the value
  std::span<const float> weights{};  // of layers of which one is the place `weight`: what steers, 0 to 1
  std::optional<Box<3>> bounds{};    // that places of layers are in; none: that of the positions
  // What a vertex stands for: a Gaussian of this standard deviation, world units, that noises are convolved
  // with in closed form, those that may_filter(), before layers fold and combine them; 0: a point.
  double filter = 0.0;
  double unit = 1.0;  // VaryingGaborOptions::unit
};

// Where places of layers are: the least box that holds all positions, a unit long where they are flat.
Box<3> place_bounds(std::span<const Vec<3>> positions);

// Evaluates a noise at all vertices, in parallel: one value per vertex, of mean `bias` and variance
// magnitude^2 (times the octaves' powers where they are not renormalised, and what a filter leaves). A value
// depends on the recipe, and on the position, normal and parameters of the vertex only: not on the mesh
// around it, the order of the vertices or the number of threads. Where nothing varies, `solid` is the field
// of GaborNoise<3>, and `kensler_solid` that of GradientNoise<3>.
//
// Throws std::invalid_argument naming the field or vertex: recipe.validate(); spans whose sizes differ; a
// parameter that is out of range, or a bandwidth that varies where the noise has none; a noise that
// has_direction() without any. Throws Cancelled.
std::vector<float> bake_noise(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices,
                              Progress* progress = nullptr);

// Layers of the noise and of solid noises, in world units (BakeRecipe::layers), and what has a name for them.
struct SurfaceLayers {
  std::vector<Layer> layers;  // none: the noise itself
  UpAxis up = UpAxis::y;
  NamedLayers fields{};             // each is evaluated once for all that use it
  std::vector<Layer> properties{};  // may use the value that the layers make (kValueField)
};

// The name by which properties use the value.
inline constexpr char kValueField[] = "value";

struct BakedLayers {
  std::vector<float> values;
  double variance = 1.0;                       // of a noise alone, what a filter leaves of it
  std::vector<std::vector<float>> properties;  // without magnitude and bias
};

// The same of layers, which take the noise's place, and of properties.
BakedLayers bake_layers(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                        const BakeVertices& vertices, Progress* progress = nullptr);

// The derivatives along the surface, per world unit, of what bake_noise() or, of layers, bake_layers() gives,
// or of the first property, if there is one, with normals, kernels and what steers held fixed. In closed form
// where all that they are made of has a gradient, else by differences over a 500th of a wave to each side. Of
// layers and properties that are filtered by differences over the filter's deviation: ramps may step within
// less, and have slopes there that no texel is as wide as. With `bounds_gradient` kernels keep the recipe's
// error for the gradient (bounding_gradient()), relative to its own root mean square, and where they vary up
// to three times that; else slopes are those of the values, which are off by up to 2.7 times as much.
std::vector<Vec<3>> bake_slopes(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                                const BakeVertices& vertices, bool bounds_gradient,
                                Progress* progress = nullptr);

// The frequencies that hold all but a thousandth of the variance, with the first octave at this frequency.
Band surface_band(const SurfaceNoiseRecipe& recipe, double frequency, double bandwidth);

}  // namespace solidnoise
