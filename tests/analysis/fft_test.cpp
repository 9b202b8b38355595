#include "solidnoise/analysis/fft.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "solidnoise/analysis/exemplar/even_transform.h"
#include "solidnoise/core/random.h"

namespace solidnoise::fft_test {
namespace {

using Complex = std::complex<double>;

// Sums of some 10^3 terms of size 1 with a rounding of 1e-16 each.
constexpr double kTolerance = 1e-11;

std::vector<double> random_values(std::size_t size) {
  std::vector<double> values(size);
  RandomStream stream(3);
  for (double& value : values) value = stream.next_unit() - 0.5;
  return values;
}

double largest_difference(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

// The definition, for two axes.
std::vector<Complex> plain_transform(const std::vector<Complex>& values, int rows, int columns) {
  std::vector<Complex> result(values.size());
  for (int k = 0; k < rows; ++k) {
    for (int l = 0; l < columns; ++l) {
      Complex sum = 0.0;
      for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
          const double turns = static_cast<double>(i * k) / rows + static_cast<double>(j * l) / columns;
          sum += values[static_cast<std::size_t>(i * columns + j)] *
                 std::polar(1.0, -2.0 * std::numbers::pi * turns);
        }
      }
      result[static_cast<std::size_t>(k * columns + l)] = sum;
    }
  }
  return result;
}

TEST(Fft, MatchesTheDefinition) {
  const std::vector<double> real = random_values(12 * 15);
  std::vector<Complex> values(real.begin(), real.end());
  for (std::size_t i = 0; i < values.size(); ++i) values[i].imag(real[values.size() - 1 - i]);
  const std::vector<Complex> expected = plain_transform(values, 12, 15);

  fft(values, std::vector<int>{12, 15}, FftDirection::forward);

  EXPECT_LT(largest_difference(values, expected), kTolerance);
}

TEST(Fft, OfRealValuesMatchesTheComplexOne) {
  const std::vector<std::vector<int>> shapes{{1},    {2},    {7},       {64},      {5, 6},      {6, 5},
                                             {1, 8}, {8, 1}, {4, 7, 6}, {3, 5, 7}, {3, 4, 5, 6}};
  for (const std::vector<int>& counts : shapes) {
    std::size_t size = 1;
    for (const int count : counts) size *= static_cast<std::size_t>(count);
    const std::vector<double> real = random_values(size);
    std::vector<Complex> expected(real.begin(), real.end());
    fft(expected, counts, FftDirection::forward);
    EXPECT_LT(largest_difference(fft_of_real(real, counts), expected), kTolerance)
        << testing::PrintToString(counts);
  }
}

TEST(Fft, TheInverseReturnsTheValuesTimesTheirNumber) {
  const std::vector<int> counts{4, 6, 10, 3};
  const std::vector<double> real = random_values(720);
  std::vector<Complex> values = fft_of_real(real, counts);

  fft(values, counts, FftDirection::inverse);

  for (Complex& value : values) value /= 720.0;
  EXPECT_LT(largest_difference(values, std::vector<Complex>(real.begin(), real.end())), kTolerance);
}

TEST(Fft, KeepsTheEnergy) {
  const std::vector<double> real = random_values(16 * 16 * 18);
  double energy = 0.0;
  for (const double value : real) energy += value * value;

  double transformed = 0.0;
  for (const Complex& value : fft_of_real(real, std::vector<int>{16, 16, 18}))
    transformed += std::norm(value);

  EXPECT_NEAR(transformed / static_cast<double>(real.size()), energy, 1e-12 * energy);
}

// KissFFT's plans have memory of their own for factors above 5, which threads must not share.
TEST(EvenTransform, IsTheSameFromAnyThreads) {
  for (const Counts3& counts : {Counts3{42, 42, 42}, Counts3{154, 1, 154}, Counts3{45, 50, 48}}) {
    const EvenTransform transform(counts);
    const std::vector<double> power = random_values(element_count(half_counts(counts, HalfAxis::last)));
    std::vector<double> lags(element_count(half_counts(counts, HalfAxis::first)));
    std::vector<double> alone(lags.size());
    tbb::task_arena(1).execute([&] { transform.to_lags(power, alone); });
    tbb::task_arena(4).execute([&] {
      for (int i = 0; i < 40; ++i) {
        transform.to_lags(power, lags);
        ASSERT_EQ(lags, alone) << counts[0];
      }
    });
  }
}

TEST(Fft, RefusesCountsThatDoNotFit) {
  std::vector<Complex> values(6);
  EXPECT_THROW(fft(values, std::vector<int>{2, 2}, FftDirection::forward), std::invalid_argument);
  EXPECT_THROW(fft(values, std::vector<int>{0, 6}, FftDirection::forward), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::fft_test
