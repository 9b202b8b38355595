#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/points.h"
#include "support/scattered.h"

namespace solidnoise::point_order_test {
namespace {

template <int Dim>
void expect_permutation_of_neighbours(std::size_t count) {
  const Scattered<Dim> scattered = scattered_points<Dim>(count, 10.0);
  std::vector<std::size_t> order = spatial_order(scattered.points());
  const auto mean_distance = [&](const std::vector<std::size_t>& numbers) {
    double sum = 0.0;
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      double square = 0.0;
      for (const auto& offset : scattered.offset) {
        square += std::pow(
            static_cast<double>(offset[numbers[i]]) - static_cast<double>(offset[numbers[i - 1]]), 2);
      }
      sum += std::sqrt(square);
    }
    return sum / static_cast<double>(numbers.size());
  };
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  if (count > 100) {
    EXPECT_LT(mean_distance(order), 0.5 * mean_distance(numbers));
  }
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, numbers);
}

TEST(PointOrder, IsAPermutationThatKeepsNeighboursTogether) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{500}, std::size_t{5000}}) {
    expect_permutation_of_neighbours<2>(count);
    expect_permutation_of_neighbours<3>(count);
    expect_permutation_of_neighbours<4>(count);
  }
}

TEST(PointOrder, TakesPointsThatAreAllTheSame) {
  const Scattered<3> one = scattered_points<3>(1, 1.0);
  const Scattered<3> same = one.picked(std::vector<std::size_t>(3000, 0));
  EXPECT_EQ(spatial_order(same.points()).size(), 3000u);
}

}  // namespace
}  // namespace solidnoise::point_order_test
