#pragma once

#include "solidnoise/analysis/dense_field.h"

namespace solidnoise::papers {

// Samples of value(x, y) on a square, x and y from -reach to reach; `side` of them along each, odd, so that
// the middle is one.
template <typename Function>
DenseField<2> sample_square(int side, double reach, const Function& value) {
  const double step = 2.0 * reach / (side - 1);
  DenseField<2> field({side, side}, Vec<2>(step));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const glm::ivec2 at = ArrayShape<2>{field.count}.position(i);
    field.values[i] = static_cast<float>(value(step * at.x - reach, step * at.y - reach));
  }
  return field;
}

}  // namespace solidnoise::papers
