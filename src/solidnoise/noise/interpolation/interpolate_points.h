#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/noise/interpolation/interpolate_axis.h"

namespace solidnoise {

// What weighs the samples around a point, along each axis: those of places between two samples, the last of
// which is the next sample's.
struct PointWeights {
  static constexpr int kPlaces = 32;
  static constexpr int kMostTaps = 8;

  int taps = 4;  // 4, 6 or 8
  std::array<std::vector<std::array<float, kMostTaps>>, 3> of_axis;
};

// A point among the samples of rows.
struct PlacedPoint {
  std::size_t first = 0;         // of the samples that it is interpolated from
  std::array<float, 3> place{};  // after the sample before it, in places: 0 to PointWeights::kPlaces
};

// Interpolates values at points, one by one: sums are taken sample by sample, with explicit multiply-adds, so
// that a value depends neither on the vector width nor on the other points. Runs the code of the widest
// instruction set that the processor has.
void interpolate_points(const PointWeights& weights, const SampleRows& rows,
                        std::span<const PlacedPoint> points, float* out);

}  // namespace solidnoise
