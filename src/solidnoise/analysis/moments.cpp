#include "solidnoise/analysis/moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

double gaussian_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

SampleMoments measure_moments(std::span<const float> values) {
  SampleMoments result;
  if (values.empty()) return result;
  result.count = static_cast<std::int64_t>(values.size());
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  result.minimum = *lowest;
  result.maximum = *highest;

  const double count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const float value : values) sum += value;
  result.mean = sum / count;

  double sum2 = 0.0;
  double sum3 = 0.0;
  double sum4 = 0.0;
  for (const float value : values) {
    const double d = value - result.mean;
    sum2 += d * d;
    sum3 += d * d * d;
    sum4 += d * d * d * d;
  }
  result.variance = sum2 / count;
  if (result.variance > 0.0) {
    result.skewness = sum3 / count / std::pow(result.variance, 1.5);
    result.excess_kurtosis = sum4 / count / (result.variance * result.variance) - 3.0;
  }
  return result;
}

SampleHistogram measure_histogram(std::span<const float> values, const HistogramOptions& options) {
  require_finite("histogram mean", options.mean);
  require_positive("histogram sigma", options.sigma);
  require_positive("histogram reach", options.reach);
  require_at_least("histogram bins", options.bins, 1);

  SampleHistogram result;
  result.lower = options.mean - options.reach * options.sigma;
  result.upper = options.mean + options.reach * options.sigma;
  result.counts.resize(static_cast<std::size_t>(options.bins));
  for (const float value : values) {
    if (value < result.lower) {
      ++result.below;
    } else if (!(value < result.upper)) {
      ++result.above;
    } else {
      const auto bin = static_cast<std::size_t>((value - result.lower) / result.width());
      ++result.counts[std::min(bin, result.counts.size() - 1)];
    }
  }

  const double count = static_cast<double>(values.size());
  for (std::size_t bin = 0; bin < result.counts.size(); ++bin) {
    const double left = (result.center(bin) - 0.5 * result.width() - options.mean) / options.sigma;
    const double right = left + result.width() / options.sigma;
    result.gaussian_counts.push_back(count * (gaussian_below(right) - gaussian_below(left)));
  }
  return result;
}

}  // namespace solidnoise
