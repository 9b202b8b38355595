#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/gabor_reference.h"

// The curl of three Gabor noises in double precision, from their impulses near a place.
namespace solidnoise::reference {

// A potential near a place: its impulses, at their positions relative to the place, and the derivative of its
// kernel along an axis.
template <typename Derivative>
struct Potential {
  std::vector<Impulse<3>> impulses;
  Derivative derivative;  // (axis, offset from the impulse, impulse)
  double amplitude = 1.0;

  double at(int axis, const Position<3>& offset) const {
    return amplitude *
           sum_impulses<3>(impulses, offset, [&](const Position<3>& d, const Impulse<3>& impulse) {
             return derivative(axis, d, impulse);
           });
  }
};

// Component i is d psi_k / d x_j - d psi_j / d x_k, (i, j, k) a cyclic permutation of the axes.
template <typename Derivative>
Position<3> curl(const std::array<Potential<Derivative>, 3>& psi, const Position<3>& offset) {
  return {psi[2].at(1, offset) - psi[1].at(2, offset), psi[0].at(2, offset) - psi[2].at(0, offset),
          psi[1].at(0, offset) - psi[0].at(1, offset)};
}

// The divergence of a function of position by differences of fourth order.
template <typename Function>
double divergence(const Function& vector, double step) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto component = [&](double distance) {
      Position<3> offset{};
      offset[axis] = distance;
      return vector(offset)[axis];
    };
    sum += (8.0 * (component(step) - component(-step)) - (component(2.0 * step) - component(-2.0 * step))) /
           (12.0 * step);
  }
  return sum;
}

}  // namespace solidnoise::reference
