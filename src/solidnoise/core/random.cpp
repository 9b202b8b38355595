#include "solidnoise/core/random.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {

AliasTable::AliasTable(std::span<const double> weights) : columns_(weights.size()) {
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
    throw std::invalid_argument(fmt::format("the weights add up to {}; they must to more than 0", total));
  }

  // Columns that are not full from the front of one array, those that overflow from its back.
  const auto count = static_cast<double>(weights.size());
  std::vector<std::uint32_t> pending(weights.size());
  std::size_t small = 0;
  std::size_t large = pending.size();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    columns_[i] = {weights[i] / total * count, static_cast<std::uint32_t>(i)};
    (columns_[i].threshold < 1.0 ? pending[small++] : pending[--large]) = static_cast<std::uint32_t>(i);
  }
  while (small > 0 && large < pending.size()) {
    Column& filled = columns_[pending[--small]];
    const std::uint32_t donor = pending[large];
    filled.alias = donor;
    columns_[donor].threshold -= 1.0 - filled.threshold;
    if (columns_[donor].threshold < 1.0) {
      ++large;
      pending[small++] = donor;
    }
  }
  // What rounding has left over.
  for (std::size_t i = 0; i < small; ++i) columns_[pending[i]].threshold = 1.0;
  for (std::size_t i = large; i < pending.size(); ++i) columns_[pending[i]].threshold = 1.0;
}

}  // namespace solidnoise
