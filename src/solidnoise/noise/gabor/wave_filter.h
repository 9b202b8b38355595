#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {

// What a filter of the frequency response exp(-pi f^2 / b^2) makes of the waves of a band of Gaussian
// parameter a (RandomPhaseGaborKernel::filtered): b^2 / (a^2 + b^2) times their frequencies w, and weights in
// proportion to exp(-pi |w|^2 / (a^2 + b^2)), 1 for the lowest.
struct WaveFilter {
  double narrower = 1.0;
  double steepness = 0.0;
  double lowest = 0.0;  // |w|^2

  WaveFilter() = default;
  WaveFilter(const SpectrumBand& band, double b) : lowest(HUGE_VAL) {
    const double sum = band.a * band.a + b * b;
    narrower = b * b / sum;
    steepness = std::numbers::pi / sum;
    for (const SpectrumComponent& component : band.components) {
      lowest = std::min(lowest, glm::dot(component.frequency, component.frequency));
    }
  }

  double weight(double square) const { return std::exp(-steepness * (square - lowest)); }
  // Of the lowest wave's kernel.
  double amplitude(int dimensions) const {
    return std::pow(narrower, 0.5 * dimensions) * std::exp(-steepness * lowest);
  }
  // Of the weights; `energy` of a kernel, by |w|^2, is a further factor of their squares.
  template <typename Energy>
  WeightMoments moments(const SpectrumBand& band, const Energy& energy) const {
    WeightMoments moments{0.0, 0.0};
    const double variance = variance_of(band);
    for (const SpectrumComponent& component : band.components) {
      const double length = glm::dot(component.frequency, component.frequency);
      const double square = weight(length) * weight(length) * energy(length);
      moments.second += component.variance / variance * square;
      moments.fourth += component.variance / variance * square * square;
    }
    return moments;
  }
};

}  // namespace solidnoise
