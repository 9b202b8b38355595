#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/volume/field/point_field.h"
#include "vdbnoise/slice_options.h"

namespace solidnoise {

// What a slice is taken of.
struct SliceField {
  std::shared_ptr<const PointField> field;
  double sigma = 0.0;              // in closed form; 0: not known
  double highest_frequency = 0.0;  // cycles per world unit; 0: not known
  std::optional<Box<3>> bounds{};  // of a grid's active voxels
};

// The fields that the options name, one for each channel of the picture: a grid, interpolated between its
// voxels, or a noise. One of a single dimension varies along x, one of two along x and y, and is constant
// along the other axes. Throws std::runtime_error (files) and std::invalid_argument.
std::vector<SliceField> make_slice_fields(const SliceOptions& options);

}  // namespace solidnoise
