#pragma once

#include <cmath>
#include <numbers>

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

}  // namespace solidnoise
