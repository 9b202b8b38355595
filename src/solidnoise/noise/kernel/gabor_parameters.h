#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The bandwidth of a Gabor kernel is the width of the band in which its amplitude spectrum exceeds half of
// the maximum, in octaves. With the spectrum's Gaussian exp(-pi (f - F0)^2 / a^2), the half-amplitude
// frequencies are F0 -+ a sqrt(ln 2 / pi), so
//   octaves = log2((F0 + h) / (F0 - h)),  h = a sqrt(ln 2 / pi).
// Frequencies and a in cycles per world unit.

// The parameter a of the Gaussian envelope exp(-pi a^2 r^2), for a bandwidth > 0 in octaves.
inline double gaussian_parameter(double frequency, double octaves) {
  const double ratio = std::exp2(octaves);
  return frequency * (ratio - 1.0) / (ratio + 1.0) * std::sqrt(std::numbers::pi / std::numbers::ln2);
}

// The bandwidth in octaves; infinite if the half-amplitude band reaches frequency 0.
inline double bandwidth_in_octaves(double frequency, double a) {
  const double half_width = a * std::sqrt(std::numbers::ln2 / std::numbers::pi);
  if (half_width >= frequency) return HUGE_VAL;
  return std::log2((frequency + half_width) / (frequency - half_width));
}

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

// Noise convolved with a Gaussian of standard deviation s, world units: with exp(-|x|^2 / (2 s^2)) over its
// integral. Its frequency response is exp(-2 pi^2 s^2 f^2) = exp(-pi f^2 / b^2), and a Gabor kernel times
// that is a Gabor kernel again, exactly (filtered() of each). A filtered noise is the sum of filtered kernels
// at the very impulses of the noise that it was made from, in their cells and with their amplitude: nothing
// is renormalised, variance and spectrum are what the filter leaves.

// b of the response, cycles per world unit; deviation > 0.
inline double filter_bandwidth(double deviation) {
  return 1.0 / (std::sqrt(2.0 * std::numbers::pi) * deviation);
}

// Throws std::invalid_argument where b would not be finite; 0 is no filter.
inline void require_filter(double deviation) {
  constexpr double kLeastFilter = 1e-12;
  if (deviation > 0.0) require_at_least("filter", deviation, kLeastFilter, "world units");
}

// What a filter leaves of a kernel.
struct FilteredShare {
  double deviation = 1.0;  // standard deviation of the noise, that of the unfiltered noise being 1
  double widening = 1.0;   // of the kernel

  // The relative error of the filtered kernel, so that the filtered noise is off by `error` of the unfiltered
  // noise's standard deviation; never more than a half.
  double error(double error) const { return std::min(0.5, error / deviation); }

  // Whether it is nothing: less than the error, or of a filter so much wider than the kernel that its
  // impulses would be too many to sum. The latter matters for bandwidths above 2 octaves only, where in 3
  // dimensions less than 0.03 is left then.
  bool nothing(double error) const { return deviation <= error || widening > kWidest; }

  static constexpr double kWidest = 6.0;
};

}  // namespace solidnoise
