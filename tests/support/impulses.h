#pragma once

// What tests of processes of impulses share: cells, the impulses in them, and whether counts are as expected.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "support/independent_values.h"

namespace solidnoise {

template <int Dim>
std::vector<Impulse<Dim>> impulses_of(const ImpulseProcess<Dim>& process, const Index<Dim>& cell) {
  std::vector<Impulse<Dim>> impulses;
  process.generate(cell, [&](const Impulse<Dim>& impulse) { impulses.push_back(impulse); });
  return impulses;
}

// The cell with this number in a cube of `side` cells per axis whose first cell is `first` on every axis.
template <int Dim>
Index<Dim> cell_in_cube(int number, int side, std::int64_t first) {
  Index<Dim> cell(first);
  for (int axis = 0; axis < Dim; ++axis) {
    cell[axis] += number % side;
    number /= side;
  }
  return cell;
}

// About 10000 cells in each dimension.
template <int Dim>
inline constexpr int kSide = std::array{0, 10000, 100, 22, 10}[Dim];
template <int Dim>
int cells_of_cube() {
  return static_cast<int>(std::lround(std::pow(kSide<Dim>, Dim)));
}

inline void expect_chi_square(const std::vector<double>& found, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
  }
  const double degrees = static_cast<double>(found.size()) - 1.0;
  EXPECT_GT(regularized_gamma_q(0.5 * degrees, 0.5 * sum), kFalseAlarm) << "chi-square " << sum;
  EXPECT_LT(regularized_gamma_q(0.5 * degrees, 0.5 * sum), 1.0 - kFalseAlarm) << "chi-square " << sum;
}

}  // namespace solidnoise
