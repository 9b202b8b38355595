#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field/shaping.h"

namespace solidnoise {

// A field that is evaluated at scattered positions instead of at a lattice: on a surface, at rest positions,
// at the voxels of a rotated grid. Immutable; may be shared between threads.
class PointField {
 public:
  virtual ~PointField() = default;

  // Overwrites `values`, one per position (world units).
  virtual void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const = 0;
};

// A noise of unit variance in a range. A value depends on the noise and the position only, but for the
// rounding of the position: of its distance from the first of a batch, to single precision.
std::unique_ptr<PointField> make_point_field(std::shared_ptr<const Noise<3>> noise,
                                             const RawShaping& shaping);

// A field of such values in a range.
std::unique_ptr<PointField> make_point_field(std::shared_ptr<const PointField> field,
                                             const RawShaping& shaping);

}  // namespace solidnoise
