#include "solidnoise/mesh/steering.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// Numbers in ascending order, and for each the area of those before it and of half of itself.
struct Distribution {
  std::vector<double> numbers;
  std::vector<double> places;

  // The number below which `percent` of the area is, linear between the numbers; 0 and 100 are the ends.
  double percentile(double percent) const {
    const double place = places.front() + percent / 100.0 * (places.back() - places.front());
    const auto found = std::upper_bound(places.begin(), places.end(), place);
    if (found == places.end()) return numbers.back();
    const auto above = static_cast<std::size_t>(found - places.begin());
    const double share = (place - places[above - 1]) / (places[above] - places[above - 1]);
    return numbers[above - 1] + share * (numbers[above] - numbers[above - 1]);
  }
};

Distribution distribution_of(std::span<const double> numbers, std::span<const double> areas) {
  std::vector<std::pair<double, std::size_t>> order;  // numbers and where they are; equal ones in that order
  order.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i]) && (areas.empty() || areas[i] > 0.0)) order.emplace_back(numbers[i], i);
  }
  if (order.empty() && !areas.empty()) return distribution_of(numbers, {});
  tbb::parallel_sort(order.begin(), order.end());
  Distribution distribution;
  distribution.numbers.reserve(order.size());
  distribution.places.reserve(order.size());
  double area = 0.0;
  for (const auto& [number, i] : order) {
    const double half = 0.5 * (areas.empty() ? 1.0 : areas[i]);
    distribution.numbers.push_back(number);
    distribution.places.push_back(area + half);
    area += 2.0 * half;
  }
  return distribution;
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

SteeringWeights make_weights(std::span<const double> numbers, const Steering& steering,
                             std::span<const double> areas) {
  steering.validate();
  if (!areas.empty() && areas.size() != numbers.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} areas for {} numbers", areas.size(), numbers.size()));
  }
  SteeringWeights result;
  result.weights.assign(numbers.size(), 0.5f);
  const Distribution distribution = distribution_of(numbers, areas);
  if (distribution.numbers.empty()) return result;
  result.least = distribution.numbers.front();
  result.most = distribution.numbers.back();
  result.low = distribution.percentile(steering.low_percentile);
  result.high = distribution.percentile(steering.high_percentile);
  if (result.low == result.high) return result;

  const auto share_of = [&](double number) {
    return std::clamp((number - result.low) / (result.high - result.low), 0.0, 1.0);
  };
  tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t i) {
    if (!std::isfinite(numbers[i])) return;
    result.weights[i] = static_cast<float>(std::pow(share_of(numbers[i]), steering.gamma));
  });
  for (const double number : numbers) {
    if (!std::isfinite(number)) continue;
    const double share = share_of(number);
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
  tbb::parallel_for(std::size_t{0}, weights.size(), [&](std::size_t i) {
    const double weight = weights[i];
    number.values[i] = static_cast<float>(logarithmic ? range.from * std::pow(range.to / range.from, weight)
                                                      : range.from + weight * (range.to - range.from));
  });
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
