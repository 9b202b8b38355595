#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// Shifts and scales values: a Map of MappedField.
struct Normalization {
  float scale = 1.0f;
  float shift = 0.0f;

  bool changes_nothing() const { return scale == 1.0f && shift == 0.0f; }
  float operator()(float value) const { return scale * value + shift; }
  float slope(float) const { return scale; }
};

// What gives a field of one channel the mean 0 and a variance in a box, where each seed's own are as far from
// those over all seeds as chance has it (what Tavernier et al. 2019, "Making Gabor Noise Fast and
// Normalized", hold against sparse convolution). Both are measured at the midpoints of a lattice, 2.5 in a
// wave of the highest frequency (cycles per world unit): exactly, by the sampling theorem, where the box is a
// period of the field. There are 2^18 at most, which know the variance of many more waves to within .3 %. A
// field that is the same everywhere is shifted only.
inline constexpr double kMostNormalizationSamples = 0x1p18;
template <int Dim>
Normalization normalization_in(const Field<Dim>& field, const Box<Dim>& box, double highest_frequency,
                               double variance);

}  // namespace solidnoise
