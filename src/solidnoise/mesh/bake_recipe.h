#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/steering.h"

namespace solidnoise {

// Which way the waves of oriented noise travel, and which way is up in a photograph that noise is made of.
struct DirectionRecipe {
  enum class Source {
    axis,           // an axis of space, laid into the tangent plane
    max_curvature,  // the principal direction of the curvature of larger magnitude
    min_curvature,  // the other one
  };

  Source source = Source::axis;
  std::optional<Vec<3>> axis{};  // any length but 0; unset: the up axis
  int smooth = 10;               // rounds of smoothing, 0 to 10000: of a field that follows the curvature

  friend bool operator==(const DirectionRecipe&, const DirectionRecipe&) = default;
};

// How densely a mesh is sampled before baking.
struct RefineRecipe {
  enum class Mode { off, automatic, rounds };

  Mode mode = Mode::off;
  int rounds = 1;  // see subdivide(), 1 to 8
  // Of automatic: most vertices, 0 for default_vertex_budget(). Edges are longer where more are needed.
  std::uint64_t budget = 0;
  RefineOptions::Method method = RefineOptions::Method::own;
  RefineOptions::Placement placement = RefineOptions::Placement::on_edges;  // of new vertices

  friend bool operator==(const RefineRecipe&, const RefineRecipe&) = default;
};

// Four times the mesh's vertices, but at least 200 000 and at most 4 million.
std::uint64_t default_vertex_budget(std::size_t vertices);

// The ramp of a noise by example that has the colours of the exemplar.
inline constexpr char kExemplarRamp[] = "exemplar";

// What frequencies, periods and warps of layers are measured in.
enum class LayerUnit {
  world,    // world units
  feature,  // feature_size_of(): then layers are as large, next to a mesh, whatever its size
};

// The property that `displace` moves vertices by, where a recipe has it.
inline constexpr char kHeightProperty[] = "height";

// Everything that a bake depends on but the mesh: plain data.
struct BakeRecipe {
  std::string description{};  // one line
  SurfaceNoiseRecipe noise{};
  // Their sum takes the noise's place; see Layer. A layer that names no noise has this one, with its
  // parameters; one that does has a solid noise of space, of the frequency that it names. Places are in the
  // mesh's box.
  std::vector<Layer> layers{};
  NamedLayers fields{};  // for layers to use
  // Numbers that vertices get beside the value: what a look needs besides a colour, such as `roughness` and
  // `height`. Their layers may use the value, kValueField.
  NamedLayers properties{};
  LayerUnit layer_unit = LayerUnit::world;
  std::optional<ParameterRange> frequency{};  // cycles per world unit; unset: one per feature_size
  std::optional<double> feature_size{};       // world units, > 0; unset: 24 lie along the box's diagonal
  ParameterRange detail{1.0, 1.0};            // over one cycle per feature_size; 0.001 to 1000
  ParameterRange bandwidth{1.0, 1.0};         // octaves; 0.1 to 4
  ParameterRange magnitude{1.0, 1.0};         // standard deviation; >= 0
  ParameterRange bias{0.0, 0.0};              // added to the noise, in standard deviations
  Steering by{};                              // what ranges follow
  int smooth = 0;                             // rounds of smoothing of the curvature, 0 to 10000
  // Of smoothing that does not depend on how the mesh is cut up, of the curvature that steers and of the
  // normals that say where the tangent plane of a noise lies; world units, >= 0. Unset: smoothing_radius().
  std::optional<double> smooth_radius{};
  DirectionRecipe direction{};
  std::string ramp = "rust";  // a name or stops, see parse_color_ramp(); or exemplar, for its own colours
  double contrast = 1.0;  // the ramp spans -2.5 to 2.5 standard deviations over this; > 0. Of an exemplar's
                          // own colours, the factor of what differs from their mean
  RefineRecipe refine{};
  // Along the normals, world units for a value of 1, or for a height of 1 where there is such a property.
  double displace = 0.0;
  UpAxis up = UpAxis::y;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
  // Whether a parameter follows the steering, or a layer does.
  bool steers() const;
  bool has_exemplar_colors() const { return ramp == kExemplarRamp; }
  // The direction's axis.
  Vec<3> direction_axis() const;
  // Whether frames at different times differ.
  bool changes_with_time() const;

  friend bool operator==(const BakeRecipe&, const BakeRecipe&) = default;
};

// What stands for the surface's noise where noises of layers have seeds mixed with its own.
NoiseRecipe noise_of_layers(const SurfaceNoiseRecipe& recipe);

// Size of a feature on a mesh whose box has this diagonal, 0 or more: feature_size, what stands for it, or
// where there is a frequency one cycle of it, of a range of the middle in octaves. World units.
double feature_size_of(const BakeRecipe& recipe, double diagonal);

// The recipe's frequencies on a mesh whose box has this diagonal, 0 or more.
ParameterRange frequencies_of(const BakeRecipe& recipe, double diagonal);

// How far curvature and normals are smoothed for these frequencies, world units: then the noise changes over
// the surface by little more than by itself. See BakeRecipe::smooth_radius.
double smoothing_radius(const BakeRecipe& recipe, const ParameterRange& frequency);

// Where a value (noise plus bias) is on the ramp, 0 to 1 within it.
float place_on_ramp(double value, double contrast);

}  // namespace solidnoise
