#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/interpolation/lattice_interpolation.h"
#include "solidnoise/noise/noise.h"
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

}  // namespace solidnoise
