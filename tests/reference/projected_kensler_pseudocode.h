#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "solidnoise/noise/gradient/gradient_lattice.h"

namespace solidnoise::reference {

// The pseudocode of Kensler et al. 2008, section 4, as it is printed, in lattice units and single precision:
// a stencil of 4 lattice points per axis (2 for half resolution, the points of even coordinates), the window
// 3 o^2 - 2 o^3 of o = 1 - |distance to the plane|. What is left to the reader: the sum begins with 0. It has
// in common with the library the random tables only.
class ProjectedKenslerPseudocode {
 public:
  enum class Projection { none, onto_plane };

  ProjectedKenslerPseudocode(Projection projection, int stride, std::uint64_t seed)
      : projection_(projection), stride_(stride), permutations_(make_permutations<3>(seed)) {
    const auto gradients = make_gradients<3>(seed);
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        gradients_[i][static_cast<std::size_t>(axis)] = static_cast<float>(gradients[i][axis]);
      }
    }
  }

  // `window_reach` is 1 as printed; half resolution needs 2: with 1 a plane between two layers is 0.
  float operator()(const std::array<float, 3>& point, const std::array<float, 3>& normal,
                   float window_reach = 1.0f) const {
    const int first = stride_ == 1 ? -1 : 0;
    const int last = stride_ == 1 ? 2 : 1;
    std::array<std::int32_t, 3> corner;
    std::array<float, 3> fraction;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corner[axis] =
          static_cast<std::int32_t>(std::floor(point[axis] / static_cast<float>(stride_))) * stride_;
      fraction[axis] = point[axis] - static_cast<float>(corner[axis]);
    }
    float sum = 0.0f;
    for (int k = first; k <= last; ++k) {
      for (int j = first; j <= last; ++j) {
        for (int i = first; i <= last; ++i) {
          sum += term(corner, fraction, normal, {i * stride_, j * stride_, k * stride_}, window_reach);
        }
      }
    }
    return sum;
  }

 private:
  float term(const std::array<std::int32_t, 3>& corner, const std::array<float, 3>& fraction,
             const std::array<float, 3>& normal, const std::array<int, 3>& step, float window_reach) const {
    std::array<float, 3> d;
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = fraction[axis] - static_cast<float>(step[axis]);
    float window = 1.0f;
    if (projection_ == Projection::onto_plane) {
      const float along = d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2];
      for (std::size_t axis = 0; axis < 3; ++axis) d[axis] -= along * normal[axis];
      const float o = 1.0f - std::abs(along) / window_reach;
      if (o <= 0.0f) return 0.0f;
      window = 3.0f * o * o - 2.0f * o * o * o;
    }
    const float squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared >= 4.0f) return 0.0f;
    std::size_t hash = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hash ^= permutations_[axis][static_cast<std::size_t>((corner[axis] + step[axis]) & 255)];
    }
    const std::array<float, 3>& gradient = gradients_[hash];
    const float t = 1.0f - 0.25f * squared;
    const float t4 = (t * t) * (t * t);
    return (d[0] * gradient[0] + d[1] * gradient[1] + d[2] * gradient[2]) * (4.0f * t4 * t - 3.0f * t4) *
           window;
  }

  Projection projection_;
  int stride_;
  std::array<std::array<std::uint8_t, 256>, 3> permutations_;
  std::array<std::array<float, 3>, kGradients> gradients_;
};

}  // namespace solidnoise::reference
