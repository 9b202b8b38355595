#pragma once

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Shifts and scales values: a Map of MappedField.
struct Normalization {
  float scale = 1.0f;
  float shift = 0.0f;

  bool changes_nothing() const { return scale == 1.0f && shift == 0.0f; }
  float operator()(float value) const { return scale * value + shift; }
  float slope(float) const { return scale; }
};

// What gives a noise the mean 0 and its variance in a box, where each seed's own are as far from those over
// all seeds as chance has it (what Tavernier et al. 2019, "Making Gabor Noise Fast and Normalized", hold
// against sparse convolution). Along axes with a period (0: none) one period, from 0 on, takes the place of
// the box, so that tiles have the values of what they are tiles of. Both are measured at the midpoints of a
// lattice, 2.5 in a wave of the highest frequency: exactly, by the sampling theorem, over periods. There are
// 2^18 at most, which know the variance of many more waves to within .3 %.
inline constexpr double kMostNormalizationSamples = 0x1p18;
template <int Dim>
Normalization normalization_in(const Noise<Dim>& noise, const Box<Dim>& box, const Vec<4>& period);

}  // namespace solidnoise
