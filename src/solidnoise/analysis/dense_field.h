#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/analysis/array_shape.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Samples of a field on a regular block, last axis fastest, as a Lattice evaluates them.
template <int Dim>
struct DenseField {
  glm::vec<Dim, int> count{1};  // samples along each axis, >= 1
  Vec<Dim> step{1.0};           // world units between samples, > 0
  std::vector<float> values;

  DenseField() = default;
  DenseField(const glm::vec<Dim, int>& count_, const Vec<Dim>& step_) : count(count_), step(step_) {
    values.resize(size());
  }

  std::size_t size() const { return ArrayShape<Dim>{count}.size(); }
};

}  // namespace solidnoise
