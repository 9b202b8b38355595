#pragma once

#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar.h"

namespace solidnoise {

// Brightness as an eye weighs the colours of linear light, in place of these.
void make_grey(Exemplar<2>& exemplar);

// Gives all exemplars as many channels: one picture in colour makes all of them so.
void agree_on_channels(std::vector<Exemplar<2>>& exemplars);

// What noise of exemplars' means and deviations is like, the mean over the exemplars.
struct ValueFit {
  double clipped = 0.0;   // share of its values that are below 0 or above 1, the mean of the channels
  double skewness = 0.0;  // of the exemplar, the largest of its channels', which noise does not have
};
ValueFit fit_of_values(std::span<const Exemplar<2>> exemplars);

// Whether no value is below 0, and squares of noise can have the mean and variance of each colour in all
// exemplars together (reached_share).
bool are_squares(std::span<const Exemplar<2>> exemplars);

struct ValueChoice {
  bool raw_values = false;  // as they are stored; otherwise linear light
  bool squares = false;     // of their square roots (ExemplarFitOptions::squares)
  ValueFit fit;             // of those chosen
};

// Chooses between the values as they are stored, which `exemplars` hold, linear light, into which they are
// then made, and squares of noise of the stored values' roots: that of less clipped / 0.005 + |skewness|,
// squares only if they may be, more than 0.005 of either other is clipped and less than half of that of
// squares, and values are_squares(). If one of them holds linear light already (`hold_linear_light`, one of
// each), all are made so.
ValueChoice choose_values(std::vector<Exemplar<2>>& exemplars, const std::vector<bool>& hold_linear_light,
                          bool may_square = true);

}  // namespace solidnoise
