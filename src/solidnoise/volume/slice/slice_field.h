#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/interpolation/lattice_interpolation.h"
#include "solidnoise/noise/noise.h"
#include "vdbnoise/slice_options.h"
#include "vdbnoise/slice_plane.h"

namespace solidnoise {

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
// (0, 0), and mapped to the range.
std::unique_ptr<SliceSource> make_slice_source(std::shared_ptr<const Noise<2>> noise,
                                               const LatticeFrame<2>& frame, RawShaping::Range range);

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
