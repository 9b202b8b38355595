#pragma once

#include <cmath>
#include <numbers>

#include "solidnoise/core/vec.h"

namespace solidnoise::reference {

// Spectral density of noise of unit variance in the plane whose kernels are exp(-pi a^2 r^2) cos(2 pi F x),
// with phase 0 and not cut: the square of their Fourier transform over the integral of their square.
inline double oriented_spectrum(double frequency, double a, const Vec<2>& f) {
  using std::numbers::pi;
  const auto gaussian = [&](double x) { return std::exp(-pi * (x * x + f.y * f.y) / (a * a)) / (a * a); };
  const double transform = 0.5 * (gaussian(f.x - frequency) + gaussian(f.x + frequency));
  const double energy = (1.0 + std::exp(-2.0 * pi * std::pow(frequency / a, 2))) / (4.0 * a * a);
  return transform * transform / energy;
}

}  // namespace solidnoise::reference
