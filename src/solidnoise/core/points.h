#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Scattered positions, in world units and double precision, so that noise is as smooth far from the world's
// origin as near it. Owns nothing.
template <int Dim>
struct Points {
  std::span<const Vec<Dim>> positions;

  // Of points of a surface, else empty: its normals there, smooth (interpolated) and of any length but 0; and
  // which vertices of its mesh they are, for fields that have a number for each vertex.
  std::span<const Vec<Dim>> normals{};
  std::span<const std::uint32_t> vertices{};

  std::size_t size() const { return positions.size(); }
  double coordinate(std::size_t point, int axis) const { return positions[point][axis]; }
};

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

// A point, by number, and its place in an order.
struct KeyedPoint {
  std::uint64_t key = 0;
  std::size_t point = 0;
};

// Sorts by the lowest `bits` bits of the keys, all others of which are 0. Points of equal keys stay as they
// are.
void sort_by_key(std::vector<KeyedPoint>& points, int bits);

// The points' numbers in an order that keeps neighbours together: along a Morton curve through their bounding
// box. Dim is 2 to 4; positions finite. The order decides the speed of an evaluation, not its result.
template <int Dim>
std::vector<std::size_t> spatial_order(const Points<Dim>& points);

}  // namespace solidnoise
