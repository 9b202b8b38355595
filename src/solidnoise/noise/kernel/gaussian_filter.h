#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace solidnoise {

// Noise convolved with a Gaussian of standard deviation s, world units: with exp(-|x|^2 / (2 s^2)) over its
// integral. Its frequency response is exp(-2 pi^2 s^2 f^2) = exp(-pi f^2 / b^2), and a Gabor kernel times
// that is a Gabor kernel again, exactly (IsotropicGaborKernel::filtered, GaborKernel::filtered). A filtered
// noise is the sum of filtered kernels at the very impulses of the noise that it was made from, in their
// cells and with their amplitude: nothing is renormalised, variance and spectrum are what the filter leaves.

// b of the response, cycles per world unit; deviation > 0.
inline double filter_bandwidth(double deviation) {
  return 1.0 / (std::sqrt(2.0 * std::numbers::pi) * deviation);
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
