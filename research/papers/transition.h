#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/noise/point/scale_transition.h"

namespace solidnoise::papers {

// Spatially varying noise of Dim dimensions whose kernel's radius is (1 + alpha) times a grid's cell, where
// the impulses of two grids are mixed (Lagae et al. 2011, section V): its variance, which should be 1.
struct TransitionVariance {
  double expected = 0.0;  // in closed form; of ScaleTransition::fade 1
  double measured = 0.0;
  double standard_error = 0.0;  // from the scatter of the parts
};

// Measured with the library's own evaluation, at `points` points half a radius apart; Dim is 2 or 3.
template <int Dim>
TransitionVariance transition_variance(ScaleTransition transition, double alpha, int points,
                                       std::uint64_t seed);

// Figure 13: an impulse of the grids of cells of 1 and 2 units, and its weight in a noise whose kernel's
// radius is 1 + alpha, 0 where it is not there.
struct WeightedImpulse {
  int level = 0;  // 0 or 1
  double x = 0.0;
  double y = 0.0;
  double weight = 0.0;
};
// Those in a square of `side` units, a whole number of cells of the coarser grid, with `impulses` mean
// impulses under a kernel.
std::vector<WeightedImpulse> weighted_impulses(ScaleTransition transition, double alpha, int side,
                                               double impulses);

// Figure 15: noise whose frequency goes from F0 / 2 to 4 F0 of the paper's example from left to right, in
// equal ratios, over so many samples; and where between two grids (alpha) each column is.
struct VaryingStrip {
  DenseField<2> noise;
  std::vector<double> alpha;
  std::vector<double> level;
  std::vector<double> column_rms;  // over the rows
};
VaryingStrip varying_strip(ScaleTransition transition, int columns, int rows, std::uint64_t seed);

}  // namespace solidnoise::papers
