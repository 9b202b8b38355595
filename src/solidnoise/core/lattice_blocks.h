#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/core/points.h"

namespace solidnoise {

// A lattice of any size, cut into blocks to be evaluated one by one, each for all of its samples' sake.
// Values do not depend on the cut.
template <int Dim>
class LatticeBlocks {
 public:
  explicit LatticeBlocks(const Lattice<Dim>& lattice) : lattice_(lattice) {
    for (int axis = 0; axis < Dim; ++axis) {
      const int side = kSides[static_cast<std::size_t>(axis)];
      blocks_[axis] = lattice.count[axis] / side + (lattice.count[axis] % side != 0 ? 1 : 0);
      size_ *= static_cast<std::size_t>(blocks_[axis]);
    }
  }

  std::size_t size() const { return size_; }

  // Evaluates a block and puts its samples where the whole lattice has them. `memory` is for what a block
  // takes; the next one may have it again.
  void evaluate(const Field<Dim>& field, std::size_t block, const Samples<Dim>& samples,
                std::vector<float>& memory) const {
    Lattice<Dim> part = lattice_;
    glm::vec<Dim, int> start(0);
    for (int axis = Dim - 1; axis >= 0; --axis) {
      const auto blocks = static_cast<std::size_t>(blocks_[axis]);
      const int side = kSides[static_cast<std::size_t>(axis)];
      start[axis] = static_cast<int>(block % blocks) * side;
      block /= blocks;
      part.first[axis] += start[axis];
      part.count[axis] = std::min(side, lattice_.count[axis] - start[axis]);
    }
    const std::size_t numbers = part.size() * static_cast<std::size_t>(field.channels());
    memory.resize(numbers * (samples.wants_gradient() ? 1 + Dim : 1));
    const auto dense = [&](std::size_t k) { return std::span(memory).subspan(k * numbers, numbers); };
    Samples<Dim> of_part{dense(0), {}};
    for (std::size_t axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
      of_part.gradient[axis] = dense(1 + axis);
    }
    field.block(part.bounds())->evaluate(part, of_part);
    scatter(start, part.count, of_part.values, samples.values);
    for (std::size_t axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
      scatter(start, part.count, of_part.gradient[axis], samples.gradient[axis]);
    }
  }

 private:
  // Samples along each axis of one block: enough to share impulses, few enough to keep them in the cache.
  // Time is not shared.
  static constexpr std::array<int, Dim> sides() {
    if constexpr (Dim == 1) return {4096};
    if constexpr (Dim == 2) return {64, 64};
    if constexpr (Dim == 3) return {32, 32, 32};
    if constexpr (Dim == 4) return {32, 32, 32, 1};
  }
  static constexpr std::array<int, Dim> kSides = sides();

  // Copies a block's samples, row by row, channel by channel.
  void scatter(const glm::vec<Dim, int>& start, const glm::vec<Dim, int>& count, std::span<const float> from,
               std::span<float> to) const {
    const auto row = static_cast<std::size_t>(count[Dim - 1]);
    glm::vec<Dim, int> index(0);
    std::size_t channel = 0;
    for (std::size_t done = 0; done < from.size(); done += row) {
      std::size_t offset = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        offset = offset * static_cast<std::size_t>(lattice_.count[axis]) +
                 static_cast<std::size_t>(start[axis] + index[axis]);
      }
      std::copy_n(from.data() + done, row, to.data() + channel * lattice_.size() + offset);
      int axis = Dim - 2;
      while (axis >= 0 && ++index[axis] == count[axis]) index[axis--] = 0;
      if (axis < 0) ++channel;
    }
  }

  Lattice<Dim> lattice_;
  glm::vec<Dim, int> blocks_{1};
  std::size_t size_ = 1;
};

}  // namespace solidnoise
