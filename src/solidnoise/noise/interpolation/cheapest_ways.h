#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace solidnoise {

// The ways to evaluate one part of a noise, each with a `cost` and a `squared_error`, of which no other beats
// any in both: the costliest and most exact one last.
template <typename Way>
std::vector<Way> best_of(const std::vector<Way>& ways) {
  std::vector<std::tuple<double, double, std::size_t>> order;
  for (std::size_t i = 0; i < ways.size(); ++i) order.emplace_back(ways[i].cost, ways[i].squared_error, i);
  std::sort(order.begin(), order.end());
  std::vector<Way> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [cost, squared_error, i] : order) {
    if (squared_error >= least) continue;
    least = squared_error;
    best.push_back(ways[i]);
  }
  return best;
}

// The cheapest way for each part, by number, whose squared errors add up to no more than the budget: all
// parts pay the same price in error. The last way of each part is to have none.
template <typename Way>
std::vector<std::size_t> choose_within(const std::vector<std::vector<Way>>& parts, double budget) {
  std::vector<std::size_t> chosen;
  const auto choose_at = [&](double price) {
    double error = 0.0;
    chosen.clear();
    for (const std::vector<Way>& ways : parts) {
      const auto total = [&](const Way& way) { return way.cost + price * way.squared_error; };
      const auto best = std::min_element(ways.begin(), ways.end(),
                                         [&](const Way& a, const Way& b) { return total(a) < total(b); });
      chosen.push_back(static_cast<std::size_t>(best - ways.begin()));
      error += best->squared_error;
    }
    return error;
  };
  double low = 0.0;
  if (choose_at(low) <= budget) return chosen;
  double high = 1.0 / budget;
  while (choose_at(high) > budget) high *= 16.0;
  constexpr int kHalvings = 50;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle = low == 0.0 ? high / 16.0 : std::sqrt(low * high);
    (choose_at(middle) > budget ? low : high) = middle;
  }
  choose_at(high);
  return chosen;
}

}  // namespace solidnoise
