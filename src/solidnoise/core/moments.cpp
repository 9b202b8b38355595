#include "solidnoise/core/moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace solidnoise {

// Sums are kept in lanes, which the compiler turns into vectors and adds up in one fixed order at the end:
// value k goes to lane k % kLanes.
Moments Moments::of(std::span<const float> values) {
  Moments result;
  if (values.empty()) return result;
  constexpr std::size_t kLanes = 8;
  using Lanes = std::array<double, kLanes>;
  const auto total = [](const Lanes& lanes) { return std::accumulate(lanes.begin(), lanes.end(), 0.0); };
  const std::size_t whole = values.size() - values.size() % kLanes;

  std::array<float, kLanes> low;
  std::array<float, kLanes> high;
  low.fill(values[0]);
  high.fill(values[0]);
  Lanes sum{};
  const auto add = [&](std::size_t lane, float value) {
    low[lane] = value < low[lane] ? value : low[lane];
    high[lane] = value > high[lane] ? value : high[lane];
    sum[lane] += value;
  };
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, values[i + lane]);
  }
  for (std::size_t i = whole; i < values.size(); ++i) add(i - whole, values[i]);
  result.count_ = values.size();
  result.min_ = *std::min_element(low.begin(), low.end());
  result.max_ = *std::max_element(high.begin(), high.end());
  const double mean = total(sum) / static_cast<double>(values.size());

  Lanes m2{};
  Lanes m3{};
  Lanes m4{};
  const auto add_powers = [&](std::size_t lane, float value) {
    const double d = value - mean;
    const double d2 = d * d;
    m2[lane] += d2;
    m3[lane] += d2 * d;
    m4[lane] += d2 * d2;
  };
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) add_powers(lane, values[i + lane]);
  }
  for (std::size_t i = whole; i < values.size(); ++i) add_powers(i - whole, values[i]);
  result.mean_ = mean;
  result.m2_ = total(m2);
  result.m3_ = total(m3);
  result.m4_ = total(m4);
  return result;
}

Moments Moments::of_constant(float value, std::uint64_t count) {
  Moments result;
  if (count == 0) return result;
  result.count_ = count;
  result.min_ = result.max_ = result.mean_ = value;
  return result;
}

void Moments::merge(const Moments& other) {
  if (other.count_ == 0) return;
  if (count_ == 0) {
    *this = other;
    return;
  }
  const double a = static_cast<double>(count_);
  const double b = static_cast<double>(other.count_);
  const double n = a + b;
  const double d = other.mean_ - mean_;
  const double d_n = d / n;
  m4_ += other.m4_ + d * d_n * d_n * d_n * a * b * (a * a - a * b + b * b) +
         6.0 * d_n * d_n * (a * a * other.m2_ + b * b * m2_) + 4.0 * d_n * (a * other.m3_ - b * m3_);
  m3_ += other.m3_ + d * d_n * d_n * a * b * (a - b) + 3.0 * d_n * (a * other.m2_ - b * m2_);
  m2_ += other.m2_ + d * d_n * a * b;
  mean_ += d_n * b;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
  count_ += other.count_;
}

double Moments::sigma() const {
  return count_ == 0 ? 0.0 : std::sqrt(m2_ / static_cast<double>(count_));
}

double Moments::skewness() const {
  return m2_ > 0.0 ? std::sqrt(static_cast<double>(count_)) * m3_ / std::pow(m2_, 1.5) : 0.0;
}

double Moments::excess_kurtosis() const {
  return m2_ > 0.0 ? static_cast<double>(count_) * m4_ / (m2_ * m2_) - 3.0 : 0.0;
}

}  // namespace solidnoise
