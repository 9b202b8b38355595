#pragma once

#include <cstdint>
#include <span>

namespace solidnoise {

// Moments of a set of values, gathered in parts: sums about the part's own mean, combined by the pairwise
// formulas of Chan et al. 1979 and Pebay 2008, which lose no digits where the mean is large against the
// spread. The result depends on the order of adding and merging, in the last bits.
class Moments {
 public:
  // The values' own moments, in two passes.
  static Moments of(std::span<const float> values);

  // Those of `count` equal values.
  static Moments of_constant(float value, std::uint64_t count);

  void merge(const Moments& other);

  std::uint64_t count() const { return count_; }
  double min() const { return min_; }    // 0 if there are no values
  double max() const { return max_; }    // 0 if there are no values
  double mean() const { return mean_; }  // 0 if there are no values
  double sigma() const;                  // of the population: divided by count
  double skewness() const;               // 0 if sigma is 0
  double excess_kurtosis() const;        // E[(v - mean)^4] / sigma^4 - 3; 0 if sigma is 0

 private:
  std::uint64_t count_ = 0;
  double min_ = 0.0;
  double max_ = 0.0;
  double mean_ = 0.0;
  double m2_ = 0.0;  // sums of powers of the distance to the mean
  double m3_ = 0.0;
  double m4_ = 0.0;
};

}  // namespace solidnoise
