#pragma once

#include "solidnoise/core/points.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"

namespace solidnoise {

// A lattice on which kernels reach `radius` samples.
template <int Dim>
LatticeFrame<Dim> frame_of(double support, double radius) {
  LatticeFrame<Dim> frame;
  for (int axis = 0; axis < Dim; ++axis) {
    frame.origin[axis] = 0.013 + axis;
    frame.step[axis] = support / radius;
  }
  return frame;
}

template <int Dim>
Lattice<Dim> lattice_of(const LatticeFrame<Dim>& frame, const Index<Dim>& first, int count) {
  return {frame.origin, frame.step, first, glm::vec<Dim, int>(count)};
}

}  // namespace solidnoise
