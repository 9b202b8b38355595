#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solidnoise/mesh/adjacency.h"

namespace solidnoise {

// Finds the points around a point, along edges. One per thread; keeps a number per point of the mesh.
class RingSearch {
 public:
  explicit RingSearch(const Adjacency& neighbours) : neighbours_(neighbours), seen_(neighbours.size()) {}

  // The points at one or two edges from `centre`, and then those at more edges, ring by ring, until there are
  // at least `count` or no more. From what a mesh has an excess of (the hub of a fan; more than some hundred)
  // an even selection is taken, so that the effort per point has a bound.
  const std::vector<std::uint32_t>& around(std::uint32_t centre, std::size_t count);

 private:
  // Appends the points one edge from those of found_[begin ..], each once.
  void add_ring(std::size_t begin);
  void add_neighbours(std::uint32_t point);

  const Adjacency& neighbours_;
  std::vector<std::uint32_t> seen_;  // in which search a point was met last
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> found_;
};

}  // namespace solidnoise
