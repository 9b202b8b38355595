#pragma once

#include <complex>

namespace solidnoise {

// How a surface bends at a point: the derivative of its unit normal along the surface, a symmetric tensor.
// Its eigenvalues are the principal curvatures, positive where the surface bends away from its normal, as a
// sphere does from the outside. In a tangent frame it is
//   [ mean + a      b     ]
//   [     b      mean - a ],   line = a + ib (see tangent_frames.h).
struct ShapeOperator {
  double mean = 0.0;                // H, 1/world unit
  std::complex<double> line = 0.0;  // 1/world unit

  ShapeOperator& operator+=(const ShapeOperator& other) {
    mean += other.mean;
    line += other.line;
    return *this;
  }
  ShapeOperator& operator-=(const ShapeOperator& other) {
    mean -= other.mean;
    line -= other.line;
    return *this;
  }
  friend ShapeOperator operator+(ShapeOperator a, const ShapeOperator& b) { return a += b; }
  friend ShapeOperator operator-(ShapeOperator a, const ShapeOperator& b) { return a -= b; }
  friend ShapeOperator operator*(double factor, const ShapeOperator& shape) {
    return {factor * shape.mean, factor * shape.line};
  }
};

}  // namespace solidnoise
