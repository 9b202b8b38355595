#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/run_options.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise {

// What the command line of `vdbnoise slice` says.
struct SliceOptions : SliceRecipe, RunOptions {
  std::string out;       // .png, .exr, or .csv for a line; empty: none
  std::string spectrum;  // .png or .exr; empty: none
  SampleType sample_type = SampleType::automatic;

  std::optional<Vec<3>> origin;  // of the plane; else 0, or the middle of the grid
  std::optional<Vec<3>> normal;
  std::optional<Vec<3>> up;
  std::optional<double> width;  // world units; else the period, or 2, or that of the grid

  bool is_line() const { return out.ends_with(".csv"); }
};

// Declares all flags, and returns those of the noise. Before they are applied the caller puts the recipe that
// they override into `options`.
std::vector<std::string> declare_slice_flags(FlagSet& flags, SliceOptions& options);

// Puts the plane through the middle of a grid's bounds, and makes it as large as they are, as far as the
// flags leave that open.
void fit_plane(SliceOptions& options, const Box<3>& bounds);

// Finishes and checks what the flags say together. Throws UsageError and std::invalid_argument.
void check_slice_options(const FlagSet& flags, SliceOptions& options,
                         const std::vector<std::string>& noise_flags);

}  // namespace solidnoise
