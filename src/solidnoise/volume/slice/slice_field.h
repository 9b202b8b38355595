#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/volume/slice/slice_plane.h"
#include "solidnoise/volume/slice/slice_source.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// A picture of a plane through a noise, a field or a grid, or a line of samples: plain data.
struct SliceRecipe {
  enum class SpectrumScale { logarithmic, linear };

  std::string file;                      // a .vdb whose grid is sliced; empty: the recipe's field is
  std::string grid;                      // of it, or of the recipe; empty: the first one that can be sliced
  std::optional<Component> component{};  // of vectors; none: all three, as colours
  VolumeRecipe recipe;                   // its `dims` may be 1 or 2 too, where it is of a noise alone
  SlicePlane plane;
  bool wraps = false;  // the plane is one period of the noise along both axes
  bool line = false;   // of a single row, each of whose samples is evaluated by itself

  std::optional<std::pair<double, double>> values;  // that are black and white; else SliceField::shown
  std::string ramp;                                 // empty: grey, proportional to the value
  bool color = false;  // of a noise alone: three channels, an exemplar's own colours, or three noises
  SpectrumScale spectrum_scale = SpectrumScale::logarithmic;
};

// What a slice is taken of.
struct SliceField {
  SliceSourcePtr source;
  std::optional<double> sigma{};   // of a noise, in closed form
  double highest_frequency = 0.0;  // cycles per world unit; 0: not known
  std::optional<std::pair<double, double>>
      shown{};                              // as black and white; none: the slice's least and greatest
  std::optional<Box<3>> bounds{};           // of a grid's active voxels
  std::optional<ExemplarModel> exemplar{};  // whose colours the three channels make
  std::vector<double> variances{};          // of the channels then
};

// The short form of the grid that is sliced of a recipe.
VolumeRecipe sliced_grid(const SliceRecipe& slice);

// Whether what is sliced of a recipe ends at its box: densities do, all that belongs to them, and bodies of
// other shapes.
bool is_bounded(const SliceRecipe& slice);

// Throws std::invalid_argument where a recipe's voxels are those of a file, whose volume can be sliced; and
// for what goes with a noise alone.
void require_sliceable(const SliceRecipe& slice);

// A grid of floats or of vectors, interpolated between its voxels; a noise (make_noise_slice()); or what a
// recipe's voxels are filled with (RecipeField) before densities are scaled, 0 outside of its shape. Throws
// std::runtime_error (files), std::invalid_argument, as require_sliceable() does, and Cancelled.
SliceField make_slice_field(const SliceRecipe& slice, Progress* progress = nullptr);

}  // namespace solidnoise
