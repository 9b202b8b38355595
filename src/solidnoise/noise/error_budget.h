#pragma once

#include <algorithm>
#include <cmath>

namespace solidnoise {

// How the error that a recipe allows, relative to the noise's standard deviation, is split. The two parts are
// nearly uncorrelated, truncation^2 + interpolation^2 = error^2. The split is fixed, so that kernels, and
// with them what is approximated, depend neither on the voxels nor on whether there is any interpolation. It
// gives kernels three quarters of the squared error: their cost goes with a power of their radius, while
// interpolation has whole steps to choose from, and all but reaches the next one with a half of the error.
struct ErrorBudget {
  double truncation = 0.0;     // root mean square error of kernels: made compact, and fitted
  double interpolation = 0.0;  // root mean square error of lattices with fewer samples

  static constexpr double kTruncationShare = 0.75;  // of the squared error
  static constexpr double kLeastTruncation = 1e-4;  // what kernels can be fitted to

  explicit ErrorBudget(double error)
      : truncation(std::max(kLeastTruncation, std::sqrt(kTruncationShare) * error)),
        interpolation(std::sqrt(std::max(0.0, error * error - truncation * truncation))) {}
};

// Options of a noise with the error that is left to its kernels; the same options for a noise without error.
template <typename Options>
Options with_truncation_share(Options options) {
  if constexpr (requires { options.error; }) options.error = ErrorBudget(options.error).truncation;
  return options;
}

}  // namespace solidnoise
