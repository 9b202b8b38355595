#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise::cumulative_table_test {
namespace {

// The exact probabilities of a table's numbers, from how much of [0, 1) draws each: between multiples of
// 1 / (n kSteps) at most one threshold per column is missed.
std::vector<double> probabilities(const CumulativeTable& table) {
  constexpr int kSteps = 20000;
  std::vector<double> shares(table.size());
  const double steps = static_cast<double>(table.size()) * kSteps;
  for (double i = 0.5; i < steps; i += 1.0) shares[table.draw(i / steps)] += 1.0 / steps;
  return shares;
}

TEST(CumulativeTable, DrawsInProportionToTheWeights) {
  for (const std::vector<double>& weights :
       {std::vector<double>{1.0}, {1.0, 1.0, 1.0}, {0.0, 5.0, 0.0, 1e-3, 2.0, 0.7}, {1e-2, 1e2}}) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<double> shares = probabilities(CumulativeTable(weights));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      EXPECT_NEAR(shares[i], weights[i] / total, 1.0 / 20000) << "number " << i << " of " << weights.size();
      EXPECT_EQ(shares[i] == 0.0, weights[i] == 0.0) << "number " << i;
    }
  }
}

// Pearson's chi-square of a long table with weights over three decades; 1e-5 of false alarms.
TEST(CumulativeTable, DrawsOfARandomStreamPassAChiSquareTest) {
  constexpr std::size_t kCount = 1000;
  constexpr int kDraws = 2'000'000;
  std::vector<double> weights;
  for (std::size_t i = 0; i < kCount; ++i) {
    weights.push_back(std::pow(10.0, 3.0 * static_cast<double>(i) / kCount));
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const CumulativeTable table(weights);
  std::vector<double> counts(kCount);
  RandomStream stream(5);
  for (int i = 0; i < kDraws; ++i) ++counts[table.draw(stream.next_unit())];
  double chi_square = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double expected = kDraws * weights[i] / total;
    ASSERT_GT(expected, 5.0);
    chi_square += std::pow(counts[i] - expected, 2) / expected;
  }
  EXPECT_GT(regularized_gamma_q(0.5 * (kCount - 1), 0.5 * chi_square), 1e-5) << chi_square;
}

TEST(CumulativeTable, RefusesWhatIsNoDistribution) {
  for (const std::vector<double>& weights :
       {std::vector<double>{}, {0.0, 0.0}, {1.0, -1.0}, {1.0, std::numeric_limits<double>::quiet_NaN()}}) {
    EXPECT_THROW(CumulativeTable{weights}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace solidnoise::cumulative_table_test
