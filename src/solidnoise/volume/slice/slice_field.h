#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/normalization.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/interpolation/lattice_interpolation.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/slice/slice_plane.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// A picture of a plane through a noise or a grid, or a line of samples: plain data.
struct SliceRecipe {
  enum class SpectrumScale { logarithmic, linear };
  enum class Component { x, y, z, length };

  std::string file;                      // a .vdb whose grid is sliced; empty: the recipe's noise is
  std::string grid;                      // of it; empty: the first one of floats or vectors
  std::optional<Component> component{};  // of a grid of vectors; none: all three, as colours
  VolumeRecipe recipe;                   // its `dims` may be 1 or 2 too
  SlicePlane plane;
  bool wraps = false;  // the plane is one period of the noise along both axes
  bool line = false;   // of a single row, each of whose samples is evaluated by itself

  std::optional<std::pair<double, double>> values;  // that are black and white; else +-3 sigmas
  std::string ramp;                                 // empty: grey, proportional to the value
  bool color = false;                               // three channels: an exemplar's own, or three noises
  SpectrumScale spectrum_scale = SpectrumScale::logarithmic;
};

// After how many world units along a direction of the plane the noise repeats; 0 if it does not, or if the
// direction is none of its axes.
double period_along(const Vec<3>& direction, const NoiseRecipe& noise);

// What the pixels of a slice have values of. Immutable; may be shared between threads.
class SliceSource {
 public:
  virtual ~SliceSource() = default;

  // Overwrites `values` by those of some pixels, column by column from the bottom up. Values of noises depend
  // on the pixel only, but for the last bits of those that are evaluated at points.
  virtual void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                        std::span<float> values) const = 0;

  // Pixels along a side of what is best evaluated together.
  virtual int tile_side() const = 0;
};

// A field at the pixels' middles.
std::unique_ptr<SliceSource> make_slice_source(FieldPtr field);

// A noise of the plane, evaluated on this lattice of the pixels' middles, whose first sample is that of pixel
// (0, 0), normalized, and mapped to the range.
std::unique_ptr<SliceSource> make_slice_source(std::shared_ptr<const Noise<2>> noise,
                                               const LatticeFrame<2>& frame,
                                               const Normalization& normalization, RawShaping::Range range);

// What a slice is taken of.
struct SliceField {
  std::shared_ptr<const SliceSource> source;
  double sigma = 0.0;              // in closed form; 0: not known
  double highest_frequency = 0.0;  // cycles per world unit; 0: not known
  std::optional<Box<3>> bounds{};  // of a grid's active voxels
};

// Throws std::invalid_argument where a recipe is of more than a noise or its layers: only the volume that it
// makes can be sliced.
void require_sliceable(const VolumeRecipe& recipe);

// The fields that are sliced, one for each channel of the picture: a grid of floats, or of vectors,
// interpolated between its voxels, or a noise. One of a single dimension varies along x, one of two along x
// and y, and is constant along the other axes. Noises that the pixels hold with room to spare are evaluated
// at fewer places and interpolated, within the recipe's error (interpolate()); not on a line. Throws
// std::runtime_error (files) and std::invalid_argument, as require_sliceable() does.
std::vector<SliceField> make_slice_fields(const SliceRecipe& slice, Progress* progress = nullptr);

}  // namespace solidnoise
