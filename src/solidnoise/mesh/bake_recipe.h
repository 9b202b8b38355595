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

// Which way the waves of oriented noise travel.
struct DirectionRecipe {
  enum class Source {
    axis,           // an axis of space, laid into the tangent plane
    max_curvature,  // the principal direction of the curvature of larger magnitude
    min_curvature,  // the other one
  };

  Source source = Source::axis;
  Vec<3> axis{0.0, 1.0, 0.0};  // any length but 0
  int smooth = 10;             // rounds of smoothing, 0 to 10000: of a field that follows the curvature

  friend bool operator==(const DirectionRecipe&, const DirectionRecipe&) = default;
};

// How densely a mesh is sampled before baking.
struct RefineRecipe {
  enum class Mode { off, automatic, rounds };

  Mode mode = Mode::off;
  int rounds = 1;  // see subdivide(), 1 to 8
  RefineOptions::Method method = RefineOptions::Method::own;
  RefineOptions::Placement placement = RefineOptions::Placement::on_edges;  // of new vertices

  friend bool operator==(const RefineRecipe&, const RefineRecipe&) = default;
};

// The ramp of a noise by example that has the colours of the exemplar.
inline constexpr char kExemplarRamp[] = "exemplar";

// Everything that a bake depends on but the mesh: plain data.
struct BakeRecipe {
  std::string description{};  // one line
  SurfaceNoiseRecipe noise{};
  // Their sum takes the noise's place; see Layer. A layer that names no noise has this one, with its
  // parameters; one that does has a solid noise of space, of the frequency that it names. Places are in the
  // mesh's box.
  std::vector<Layer> layers{};
  std::optional<ParameterRange>
      frequency{};                     // cycles per world unit; unset: suits the mesh, default_frequency()
  ParameterRange detail{1.0, 1.0};     // of what suits the mesh, where frequency is unset; 0.001 to 1000
  ParameterRange bandwidth{1.0, 1.0};  // octaves; 0.1 to 4
  ParameterRange magnitude{1.0, 1.0};  // standard deviation; >= 0
  ParameterRange bias{0.0, 0.0};       // added to the noise, in standard deviations
  Steering by{};                       // what ranges follow
  int smooth = 2;                      // rounds of smoothing of the curvature, 0 to 10000
  double smooth_radius = 0.0;          // of smoothing that does not depend on the mesh, world units; >= 0
  DirectionRecipe direction{};
  std::string ramp = "rust";  // a name or stops, see parse_color_ramp(); or exemplar, for its own colours
  double contrast = 1.0;  // the ramp spans -2.5 to 2.5 standard deviations over this; > 0. Of an exemplar's
                          // own colours, the factor of what differs from their mean
  RefineRecipe refine{};
  double displace = 0.0;  // along the normals, world units for a value of 1
  UpAxis up = UpAxis::y;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
  // Whether a parameter follows the steering.
  bool steers() const;
  bool has_exemplar_colors() const { return ramp == kExemplarRamp; }
  // Whether frames at different times differ.
  bool changes_with_time() const;

  friend bool operator==(const BakeRecipe&, const BakeRecipe&) = default;
};

// What stands for the surface's noise where noises of layers have seeds mixed with its own.
NoiseRecipe noise_of_layers(const SurfaceNoiseRecipe& recipe);

// A frequency that suits a mesh: 24 features along the diagonal of its box, or fewer where its edges are too
// long to show them: `highest`, the noise's highest frequency over its principal one, then is 0.5 cycles per
// edge. `diagonal` and `mean_edge` in world units, > 0.
double default_frequency(double diagonal, double mean_edge, double highest);

// Where a value (noise plus bias) is on the ramp, 0 to 1 within it.
float place_on_ramp(double value, double contrast);

}  // namespace solidnoise
