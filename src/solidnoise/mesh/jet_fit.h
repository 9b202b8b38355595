#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/tangent_frames.h"

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

// A neighbour in the frame of a point: the point is the origin, its normal the third axis.
struct Neighbour {
  Vec<3> offset;  // world units
  double weight;  // >= 0
};

// Fits a polynomial of x and y to the heights z of a point and its neighbours, by weighted least squares (the
// point has the weight 1), and takes the shape operator from its derivatives at the point, in the surface's
// tangent plane turned onto the frame's. After Cazals and Pouget 2005: with a polynomial of degree n the
// curvature of a smooth surface is off by O(h^(n-1)) if neighbours are at distances in proportion to h. The
// degree is 3, for second order, or less where neighbours are too few or on too few lines: 2 from 7
// neighbours; otherwise 2 without slope, the frame's normal being taken as the surface's. What is not
// determined even then is 0.
//
// Coordinates are scaled so that the neighbours lie around the point alike in all directions: stretched
// triangles do not make the fit worse. Precondition: finite numbers.
ShapeOperator fit_shape(std::span<const Neighbour> neighbours);

}  // namespace solidnoise
