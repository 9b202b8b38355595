#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace solidnoise {

// The moments of a set of values, in double precision, by two passes. All but count are 0 for no values.
struct SampleMoments {
  std::int64_t count = 0;
  double minimum = 0.0;
  double maximum = 0.0;
  double mean = 0.0;
  double variance = 0.0;         // mean square distance from the mean (divided by count)
  double skewness = 0.0;         // E[d^3] / variance^(3/2); 0 where the variance is 0
  double excess_kurtosis = 0.0;  // E[d^4] / variance^2 - 3; 0 where the variance is 0
};

SampleMoments measure_moments(std::span<const float> values);

// Counts of values in bins of equal width, and what a Gaussian of the given mean and standard deviation would
// give. A value at an inner edge belongs to the upper bin.
struct SampleHistogram {
  double lower = 0.0;
  double upper = 0.0;
  std::vector<std::int64_t> counts;
  std::vector<double> gaussian_counts;
  std::int64_t below = 0;  // values under `lower`
  std::int64_t above = 0;  // values at or over `upper`

  double width() const { return (upper - lower) / static_cast<double>(counts.size()); }
  double center(std::size_t bin) const { return lower + (static_cast<double>(bin) + 0.5) * width(); }
};

struct HistogramOptions {
  double mean = 0.0;   // of the Gaussian
  double sigma = 1.0;  // standard deviation of the Gaussian; > 0
  double reach = 4.0;  // the bins cover mean +- reach * sigma; > 0
  int bins = 64;       // >= 1
};

// Throws std::invalid_argument for options out of range.
SampleHistogram measure_histogram(std::span<const float> values, const HistogramOptions& options);

}  // namespace solidnoise
