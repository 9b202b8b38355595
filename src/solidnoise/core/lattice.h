#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// A regular block of sample positions: sample (i0, i1, ...) is at origin + step * (first + i), in world
// units. `origin` is where the *global* index 0 lies, so that a sample's position, to the last bit, does not
// depend on which block it was asked for in. Samples are stored with the last axis fastest, as in an OpenVDB
// leaf.
template <int Dim>
struct Lattice {
  Vec<Dim> origin{0.0};
  Vec<Dim> step{1.0};           // > 0
  Index<Dim> first{0};          // global index of the first sample
  glm::vec<Dim, int> count{1};  // samples along each axis, >= 1

  double coordinate(int axis, std::int64_t i) const {
    return origin[axis] + step[axis] * static_cast<double>(first[axis] + i);
  }

  std::size_t size() const {
    std::size_t samples = 1;
    for (int axis = 0; axis < Dim; ++axis) samples *= static_cast<std::size_t>(count[axis]);
    return samples;
  }

  // The smallest box that holds every sample.
  Box<Dim> bounds() const {
    Box<Dim> box;
    for (int axis = 0; axis < Dim; ++axis) {
      box.lower[axis] = coordinate(axis, 0);
      box.upper[axis] = coordinate(axis, count[axis] - 1);
    }
    return box;
  }
};

// Appends the positions of a lattice's samples, in its order.
inline void append_positions(const Lattice<3>& lattice, std::vector<Vec<3>>& positions) {
  positions.reserve(positions.size() + lattice.size());
  for (int i = 0; i < lattice.count.x; ++i) {
    for (int j = 0; j < lattice.count.y; ++j) {
      for (int k = 0; k < lattice.count.z; ++k) {
        positions.emplace_back(lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k));
      }
    }
  }
}

inline std::vector<Vec<3>> positions_of(std::span<const Lattice<3>> lattices) {
  std::vector<Vec<3>> positions;
  for (const Lattice<3>& lattice : lattices) append_positions(lattice, positions);
  return positions;
}

}  // namespace solidnoise
