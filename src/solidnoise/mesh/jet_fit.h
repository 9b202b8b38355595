#pragma once

#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/shape_operator.h"

namespace solidnoise {

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
