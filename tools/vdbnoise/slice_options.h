#pragma once

#include <optional>
#include <string>
#include <utility>

#include "common/flag_set.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/volume_recipe.h"
#include "vdbnoise/slice_plane.h"

namespace solidnoise {

// What the command line of `vdbnoise slice` says.
struct SliceOptions {
  enum class SpectrumScale { logarithmic, linear };

  std::string file;     // a .vdb whose grid is sliced; empty: the recipe's noise is
  std::string grid;     // of it; empty: the first one of floats
  VolumeRecipe recipe;  // its `dims` may be 1 or 2 too

  std::string out;       // .png, .exr, or .csv for a line; empty: none
  std::string spectrum;  // .png or .exr; empty: none
  SpectrumScale spectrum_scale = SpectrumScale::logarithmic;
  SampleType sample_type = SampleType::automatic;
  std::optional<std::pair<double, double>> values;  // that are black and white; else +-3 sigmas
  std::string ramp;                                 // empty: grey, proportional to the value
  bool color = false;                               // three channels: an exemplar's own, or three noises
  Existing existing = Existing::refuse;

  SlicePlane plane;
  std::optional<Vec<3>> origin;  // of the plane; else 0, or the middle of the grid
  std::optional<Vec<3>> normal;
  std::optional<Vec<3>> up;
  std::optional<double> width;  // world units; else the period, or 2, or that of the grid
  bool wraps = false;           // the plane is one period of the noise along both axes
  int threads = 0;              // 0: as many as the machine has
  bool quiet = false;

  bool is_line() const { return out.ends_with(".csv"); }
};

// After how many world units along a direction of the plane the noise repeats; 0 if it does not, or if the
// direction is none of its axes.
double period_along(const Vec<3>& direction, const NoiseRecipe& noise);

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`.
void declare_slice_flags(FlagSet& flags, SliceOptions& options);

// Puts the plane through the middle of a grid's bounds, and makes it as large as they are, as far as the
// flags leave that open.
void fit_plane(SliceOptions& options, const Box<3>& bounds);

// Finishes and checks what the flags say together. Throws UsageError and std::invalid_argument.
void check_slice_options(const FlagSet& flags, SliceOptions& options);

}  // namespace solidnoise
