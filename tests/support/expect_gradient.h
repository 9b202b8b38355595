#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/field.h"

namespace solidnoise {

// Where the derivative is taken: how fast values change there, and along what.
template <int Dim>
struct Slopes {
  std::vector<double> frequency, magnitude;
  std::vector<std::vector<Vec<Dim>>> directions;  // for each a unit vector per point
};

// Values and gradient, which is compared with the differences over four places along a direction,
//   (f(-2 h) - 8 f(-h) + 8 f(h) - f(2 h)) / (12 h),  h = 0.004 / F,
// in units of 2 pi F, and of its own size where kernels have high peaks. The values' rounding, 1e-5 of the
// deviation (see varying_gabor_test.cpp; most of it is the same at all places), adds 1.5e-5 / (0.004 2 pi) =
// 6e-4. Third derivatives jump where kernels end: of a wave of frequency 3 F, (2 pi 3 h F)^2 / 6 = 1e-3.
template <int Dim, typename Evaluate>
void expect_gradient(const std::vector<Vec<Dim>>& positions, const Slopes<Dim>& slopes,
                     const Evaluate& evaluate) {
  constexpr double kStep = 0.004;
  constexpr double kTolerance = 1.6e-3;
  const std::size_t count = positions.size();
  std::vector<float> values(count), plain(count);
  std::array<std::vector<float>, Dim> gradient;
  Samples<Dim> samples{values, {}};
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    gradient[axis].resize(count);
    samples.gradient[axis] = gradient[axis];
  }
  evaluate(Points<Dim>{positions}, samples);
  evaluate(Points<Dim>{positions}, Samples<Dim>{plain, {}});
  EXPECT_EQ(values, plain);
  for (const std::vector<Vec<Dim>>& direction : slopes.directions) {
    std::vector<double> expected(count, 0.0);
    for (const auto& [steps, weight] : {std::pair(-2.0, 1.0), {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
      std::vector<Vec<Dim>> moved = positions;
      for (std::size_t i = 0; i < count; ++i) moved[i] += steps * kStep / slopes.frequency[i] * direction[i];
      evaluate(Points<Dim>{moved}, Samples<Dim>{plain, {}});
      for (std::size_t i = 0; i < count; ++i) {
        expected[i] += weight * plain[i] * slopes.frequency[i] / (12.0 * kStep);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      double along = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        along += gradient[static_cast<std::size_t>(axis)][i] * direction[i][axis];
      }
      const double scale = 2.0 * std::numbers::pi * slopes.frequency[i] * slopes.magnitude[i];
      ASSERT_NEAR((along - expected[i]) / (scale + std::abs(expected[i])), 0.0, kTolerance) << "point " << i;
    }
  }
}

}  // namespace solidnoise
