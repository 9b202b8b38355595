#include "solidnoise/field/edge_cover.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "solidnoise/field/shaping.h"

namespace solidnoise {
namespace {

// An array of three axes, of which one at a time gets another number of samples: `before` arrays of `samples`
// rows of `row` numbers.
struct Axis {
  std::size_t before = 1;
  std::size_t samples = 1;
  std::size_t row = 1;
};

Axis axis_of(const glm::ivec3& count, int axis) {
  Axis result{1, static_cast<std::size_t>(count[axis]), 1};
  for (int i = 0; i < axis; ++i) result.before *= static_cast<std::size_t>(count[i]);
  for (int i = axis + 1; i < 3; ++i) result.row *= static_cast<std::size_t>(count[i]);
  return result;
}

// From n samples to 2 (n - 1), at a quarter and three quarters between each two.
std::vector<float> refine(const std::vector<float>& values, const Axis& axis) {
  std::vector<float> fine(axis.before * 2 * (axis.samples - 1) * axis.row);
  float* to = fine.data();
  for (std::size_t i = 0; i < axis.before; ++i) {
    const float* from = values.data() + i * axis.samples * axis.row;
    for (std::size_t j = 0; j + 1 < axis.samples; ++j, from += axis.row, to += 2 * axis.row) {
      for (std::size_t k = 0; k < axis.row; ++k) {
        const float a = from[k];
        const float b = from[k + axis.row];
        to[k] = 0.75f * a + 0.25f * b;
        to[k + axis.row] = 0.25f * a + 0.75f * b;
      }
    }
  }
  return fine;
}

// From 2 (n - 1) of these to the n - 2 samples in the middle.
std::vector<float> gather(const std::vector<float>& fine, const Axis& axis) {
  const std::size_t samples = axis.samples / 2 - 1;
  std::vector<float> values(axis.before * samples * axis.row);
  float* to = values.data();
  for (std::size_t i = 0; i < axis.before; ++i) {
    const float* from = fine.data() + i * axis.samples * axis.row;
    for (std::size_t j = 0; j < samples; ++j, from += 2 * axis.row, to += axis.row) {
      for (std::size_t k = 0; k < axis.row; ++k) {
        to[k] = 0.125f * (from[k] + from[k + 3 * axis.row]) +
                0.375f * (from[k + axis.row] + from[k + 2 * axis.row]);
      }
    }
  }
  return values;
}

std::vector<float> refine(std::span<const float> values, glm::ivec3 count) {
  std::vector<float> fine(values.begin(), values.end());
  for (int axis = 0; axis < 3; ++axis) {
    fine = refine(fine, axis_of(count, axis));
    count[axis] = 2 * (count[axis] - 1);
  }
  return fine;
}

}  // namespace

void edge_cover(const glm::ivec3& count, std::span<const float> level, std::span<const float> width,
                std::span<float> cover) {
  bool is_outside = true;
  bool is_inside = true;
  for (std::size_t i = 0; i < level.size(); ++i) {
    is_outside = is_outside && level[i] <= -0.5f * width[i];
    is_inside = is_inside && level[i] >= 0.5f * width[i];
  }
  if (is_outside || is_inside) return std::fill(cover.begin(), cover.end(), is_inside ? 1.0f : 0.0f);
  std::vector<float> fine = refine(level, count + 2);
  const std::vector<float> widths = refine(width, count + 2);
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = smoothstep(0.5f + fine[i] / widths[i]);
  glm::ivec3 size = 2 * (count + 1);
  for (int axis = 0; axis < 3; ++axis) {
    fine = gather(fine, axis_of(size, axis));
    size[axis] = count[axis];
  }
  std::copy(fine.begin(), fine.end(), cover.begin());
}

}  // namespace solidnoise
