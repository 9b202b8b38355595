#include "solidnoise/core/random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {

CumulativeTable::CumulativeTable(std::span<const double> weights) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  if (weights.size() > kMost) {
    throw std::invalid_argument(fmt::format("there are {} weights; at most {}", weights.size(), kMost));
  }
  for (const double weight : weights) {
    if (!(weight >= 0.0) || !std::isfinite(weight)) {
      throw std::invalid_argument(fmt::format("a weight is {}; it must be 0 or more, and finite", weight));
    }
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(total > 0.0) || !std::isfinite(total)) {
    throw std::invalid_argument(fmt::format("the weights add up to {}; the sum must be more than 0", total));
  }

  double sum = 0.0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    upto_.push_back(sum / total);
    if (weights[i] > 0.0) last = i;
  }
  std::fill(upto_.begin() + static_cast<std::ptrdiff_t>(last), upto_.end(),
            1.0);  // whatever rounding has left
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    while (static_cast<double>(i) / static_cast<double>(size()) >= upto_[number]) ++number;
    guide_.push_back(number);
  }
}

}  // namespace solidnoise
