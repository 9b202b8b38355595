#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// How the elements of an array with the last axis fastest are numbered.
template <int Dim>
struct ArrayShape {
  glm::vec<Dim, int> count{1};

  std::size_t size() const {
    std::size_t result = 1;
    for (int axis = 0; axis < Dim; ++axis) result *= static_cast<std::size_t>(count[axis]);
    return result;
  }

  // How far apart neighbours along an axis are.
  std::size_t stride(int axis) const {
    std::size_t result = 1;
    for (int later = axis + 1; later < Dim; ++later) result *= static_cast<std::size_t>(count[later]);
    return result;
  }

  std::size_t index(const glm::vec<Dim, int>& position) const {
    std::size_t result = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      result = result * static_cast<std::size_t>(count[axis]) + static_cast<std::size_t>(position[axis]);
    }
    return result;
  }

  glm::vec<Dim, int> position(std::size_t index) const {
    glm::vec<Dim, int> result(0);
    for (int axis = Dim - 1; axis >= 0; --axis) {
      result[axis] = static_cast<int>(index % static_cast<std::size_t>(count[axis]));
      index /= static_cast<std::size_t>(count[axis]);
    }
    return result;
  }
};

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
