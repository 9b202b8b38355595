#pragma once

#include <optional>
#include <string>

#include "common/flag_set.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise {

// What the command line of `vdbnoise slice` says.
struct SliceOptions : SliceRecipe {
  std::string out;       // .png, .exr, or .csv for a line; empty: none
  std::string spectrum;  // .png or .exr; empty: none
  SampleType sample_type = SampleType::automatic;
  Existing existing = Existing::refuse;

  std::optional<Vec<3>> origin;  // of the plane; else 0, or the middle of the grid
  std::optional<Vec<3>> normal;
  std::optional<Vec<3>> up;
  std::optional<double> width;  // world units; else the period, or 2, or that of the grid
  int threads = 0;              // 0: as many as the machine has
  bool quiet = false;

  bool is_line() const { return out.ends_with(".csv"); }
};

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`.
void declare_slice_flags(FlagSet& flags, SliceOptions& options);

// Puts the plane through the middle of a grid's bounds, and makes it as large as they are, as far as the
// flags leave that open.
void fit_plane(SliceOptions& options, const Box<3>& bounds);

// Finishes and checks what the flags say together. Throws UsageError and std::invalid_argument.
void check_slice_options(const FlagSet& flags, SliceOptions& options);

}  // namespace solidnoise
