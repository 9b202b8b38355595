#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solidnoise/core/box.h"
#include "vdbnoise/slice_options.h"
#include "vdbnoise/slice_source.h"

namespace solidnoise {

// What a slice is taken of.
struct SliceField {
  std::shared_ptr<const SliceSource> source;
  double sigma = 0.0;              // in closed form; 0: not known
  double highest_frequency = 0.0;  // cycles per world unit; 0: not known
  std::optional<Box<3>> bounds{};  // of a grid's active voxels
};

// The fields that the options name, one for each channel of the picture: a grid, interpolated between its
// voxels, or a noise. One of a single dimension varies along x, one of two along x and y, and is constant
// along the other axes. Noises that the pixels hold with room to spare are evaluated at fewer places and
// interpolated, within the recipe's error (interpolate()); not on a line. Throws std::runtime_error (files)
// and std::invalid_argument.
std::vector<SliceField> make_slice_fields(const SliceOptions& options);

}  // namespace solidnoise
