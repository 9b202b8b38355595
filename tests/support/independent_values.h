#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/points.h"
#include "support/evaluated.h"

namespace solidnoise {

// Of every chi-square: one false alarm in 1e5.
inline constexpr double kFalseAlarm = 1e-5;

// A lattice of about 20000 samples so far apart that no two of them see the same impulse: their values are
// independent to the last bit. `support` is how far an impulse reaches.
template <int Dim>
Lattice<Dim> independent_lattice(double support, double origin = 0.0) {
  constexpr std::array kCount = {20000, 141, 27, 12};
  Lattice<Dim> lattice;
  lattice.origin = Vec<Dim>(origin + 0.37 * support);
  lattice.step = Vec<Dim>(2.0 * support);
  lattice.first = Index<Dim>(-3);
  lattice.count = glm::vec<Dim, int>(kCount[Dim - 1]);
  return lattice;
}

// Mean and standard error of the mean of independent numbers.
struct Estimate {
  double mean = 0.0;
  double error = 0.0;
};

template <typename Value, typename Function>
Estimate estimate_mean(const std::vector<Value>& values, const Function& function) {
  const double count = static_cast<double>(values.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const Value& value : values) {
    const double x = function(static_cast<double>(value));
    sum += x;
    squares += x * x;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((squares / count - mean * mean) / count)};
}

// Within 4 standard errors: 6e-5 of false alarms, each.
inline void expect_within_4_sigma(const Estimate& estimated, double expected) {
  EXPECT_NEAR(estimated.mean, expected, 4.0 * estimated.error) << "standard error " << estimated.error;
}

// Of the products of two sets of independent numbers of unit variance, independent of each other too; the
// products' variance is 1.
inline void expect_uncorrelated(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  const double count = static_cast<double>(a.size());
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
}

template <int Dim>
std::vector<float> values_of(const Noise<Dim>& noise, const Lattice<Dim>& lattice) {
  std::vector<float> values(lattice.size());
  noise.evaluate(lattice, Samples<Dim>{values, {}});
  return values;
}

}  // namespace solidnoise
