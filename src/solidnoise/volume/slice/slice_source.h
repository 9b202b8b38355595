#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "solidnoise/core/field.h"
#include "solidnoise/volume/slice/slice_plane.h"

namespace solidnoise {

// What the pixels of a slice have values of. Immutable; may be shared between threads.
class SliceSource {
 public:
  virtual ~SliceSource() = default;

  virtual int channels() const { return 1; }

  // Overwrites `values` by those of some pixels, channel after channel, each column by column from the bottom
  // up. Values of noises depend on the pixel only, but for the last bits of those that are evaluated at
  // points.
  virtual void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                        std::span<float> values) const = 0;

  // Pixels along a side of what is best evaluated together.
  virtual int tile_side() const = 0;
};
using SliceSourcePtr = std::shared_ptr<const SliceSource>;

// Of a vector: one of its components, or its length.
enum class Component { x, y, z, length };

// What of a field's channels is sliced: all of some that follow each other, or, of three, a component.
struct SlicedChannels {
  int first = 0;
  int count = 1;
  std::optional<Component> component{};
};

// A field at the pixels' middles: all its channels, or these.
SliceSourcePtr make_slice_source(FieldPtr field);
SliceSourcePtr make_slice_source(FieldPtr field, const SlicedChannels& channels);

// The channels of several sources, one after the other.
SliceSourcePtr side_by_side(std::vector<SliceSourcePtr> sources);

}  // namespace solidnoise
