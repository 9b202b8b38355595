#include "solidnoise/mesh/steering.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// The number below which `percent` of the sorted numbers lie, linear between them.
double percentile(std::span<const double> sorted, double percent) {
  const double place = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

void Steering::validate() const {
  require_in_range("percentiles", low_percentile, 0.0, 100.0);
  require_in_range("percentiles", high_percentile, 0.0, 100.0);
  if (low_percentile >= high_percentile) {
    throw std::invalid_argument(fmt::format("percentiles is {} {}; the first must be less than the second",
                                            low_percentile, high_percentile));
  }
  require_positive("gamma", gamma);
  if ((source == SteeringSource::attribute) == attribute.empty()) {
    throw std::invalid_argument(attribute.empty()
                                    ? "attribute is empty; it must be the name of a number of the vertices"
                                    : "attribute is given; it has no effect on this source");
  }
}

SteeringWeights make_weights(std::span<const double> numbers, const Steering& steering) {
  steering.validate();
  SteeringWeights result;
  result.weights.assign(numbers.size(), 0.5f);
  std::vector<double> sorted;
  sorted.reserve(numbers.size());
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(sorted),
               [](double number) { return std::isfinite(number); });
  if (sorted.empty()) return result;
  std::sort(sorted.begin(), sorted.end());
  result.least = sorted.front();
  result.most = sorted.back();
  result.low = percentile(sorted, steering.low_percentile);
  result.high = percentile(sorted, steering.high_percentile);
  if (result.low == result.high) return result;

  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) continue;
    const double share = std::clamp((numbers[i] - result.low) / (result.high - result.low), 0.0, 1.0);
    result.weights[i] = static_cast<float>(std::pow(share, steering.gamma));
    const auto bin = static_cast<std::size_t>(share * SteeringWeights::kBins);
    ++result.histogram[std::min(bin, SteeringWeights::kBins - 1)];
  }
  return result;
}

VertexNumber steer(const ParameterRange& range, Interpolation interpolation, std::span<const float> weights) {
  if (!range.varies()) return {range.from, {}};
  const bool logarithmic = interpolation == Interpolation::logarithmic;
  VertexNumber number{logarithmic ? std::sqrt(range.from * range.to) : 0.5 * (range.from + range.to), {}};
  number.values.resize(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double weight = weights[i];
    number.values[i] = static_cast<float>(logarithmic ? range.from * std::pow(range.to / range.from, weight)
                                                      : range.from + weight * (range.to - range.from));
  }
  return number;
}

std::string draw_histogram(const SteeringWeights& weights, std::size_t width) {
  constexpr std::size_t kBinsPerLine = 4;
  constexpr std::size_t kLines = SteeringWeights::kBins / kBinsPerLine;
  std::array<std::size_t, kLines> lines{};
  for (std::size_t bin = 0; bin < SteeringWeights::kBins; ++bin)
    lines[bin / kBinsPerLine] += weights.histogram[bin];
  const std::size_t most = std::max<std::size_t>(1, *std::max_element(lines.begin(), lines.end()));
  std::string text;
  for (std::size_t line = 0; line < kLines; ++line) {
    const double from = weights.low + (weights.high - weights.low) * static_cast<double>(line) / kLines;
    text += fmt::format("{:>12.4g} {:<{}} {}\n", from, std::string(lines[line] * width / most, '#'), width,
                        lines[line]);
  }
  return text;
}

}  // namespace solidnoise
