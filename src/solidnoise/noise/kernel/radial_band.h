#pragma once

#include <algorithm>
#include <vector>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The band that holds all but a thousandth of the variance, half of it lost on each side, of a spectrum
// around `frequency` whose Gaussian parameter is `a`. `density(f)` is the radial density of variance, up to a
// factor.
template <int Dim, typename Density>
typename Noise<Dim>::Band radial_band(const Density& density, double frequency, double a) {
  constexpr int kSteps = 4000;
  constexpr double kLostPerSide = 0.5e-3;
  const double lowest = std::max(0.0, frequency - 3.0 * a);
  const double step = (frequency + 3.0 * a - lowest) / kSteps;
  std::vector<double> cumulative{0.0};
  for (int i = 0; i < kSteps; ++i)
    cumulative.push_back(cumulative.back() + density(lowest + (i + 0.5) * step));
  const auto frequency_at = [&](double fraction) {
    const auto it = std::lower_bound(cumulative.begin(), cumulative.end(), fraction * cumulative.back());
    return lowest + step * static_cast<double>(it - cumulative.begin());
  };
  return {frequency_at(kLostPerSide), frequency_at(1.0 - kLostPerSide)};
}

}  // namespace solidnoise
