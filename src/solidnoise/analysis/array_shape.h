#pragma once

#include <cstddef>

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

}  // namespace solidnoise
