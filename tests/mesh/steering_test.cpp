#include "solidnoise/mesh/steering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message_of.h"

namespace solidnoise::steering_test {
namespace {

std::vector<double> up_to(int count) {
  std::vector<double> numbers(static_cast<std::size_t>(count) + 1);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

TEST(Steering, PercentilesBoundTheWeights) {
  const SteeringWeights result = make_weights(up_to(1000), {.low_percentile = 10.0, .high_percentile = 90.0});
  EXPECT_EQ(result.low, 100.0);
  EXPECT_EQ(result.high, 900.0);
  EXPECT_EQ(result.least, 0.0);
  EXPECT_EQ(result.most, 1000.0);
  EXPECT_EQ(result.weights[50], 0.0f);
  EXPECT_EQ(result.weights[500], 0.5f);
  EXPECT_EQ(result.weights[950], 1.0f);
  EXPECT_EQ(std::accumulate(result.histogram.begin(), result.histogram.end(), std::size_t{0}), 1001u);
}

TEST(Steering, AFewExtremeVerticesDoNotTakeTheRange) {
  std::vector<double> numbers = up_to(1000);
  numbers[0] = -1e30;
  numbers[1000] = 1e30;
  EXPECT_EQ(make_weights(numbers, {}).weights[500], make_weights(up_to(1000), {}).weights[500]);
}

// Nine tenths of the vertices on one tenth of the area: the median is that of the area.
TEST(Steering, NumbersCountByTheirAreas) {
  std::vector<double> numbers = up_to(1000);
  std::vector<double> areas(1001, 9.0);
  for (int i = 0; i < 9000; ++i) {
    numbers.push_back(2000.0);
    areas.push_back(1.0 / 9.0);
  }
  const Steering to_median{.low_percentile = 0.0, .high_percentile = 50.0};
  EXPECT_EQ(make_weights(numbers, to_median).high, 2000.0);
  // Half of the area of 10009, at 9 per number; the ends count half.
  EXPECT_NEAR(make_weights(numbers, to_median, areas).high, 555.8, 0.1);
  EXPECT_THROW(make_weights(up_to(3), to_median, std::vector(3, 1.0)), std::invalid_argument);
}

TEST(Steering, NumbersWithoutAreaDoNotCountUnlessAllAreSo) {
  std::vector<double> areas(101, 1.0);
  areas[0] = areas[100] = 0.0;
  const SteeringWeights result = make_weights(up_to(100), {}, areas);
  EXPECT_EQ(result.least, 1.0);
  EXPECT_EQ(result.most, 99.0);
  EXPECT_EQ(result.weights[100], 1.0f);
  const std::vector<double> none(101, 0.0);
  EXPECT_EQ(make_weights(up_to(100), {}, none).weights, make_weights(up_to(100), {}).weights);
}

TEST(Steering, GammaIsAnExponent) {
  const auto weights =
      make_weights(up_to(1000), {.low_percentile = 0.0, .high_percentile = 100.0, .gamma = 2.0}).weights;
  EXPECT_FLOAT_EQ(weights[500], 0.25f);
  EXPECT_EQ(weights[1000], 1.0f);
}

TEST(Steering, OneNumberEverywhereIsTheMiddle) {
  const SteeringWeights result = make_weights(std::vector<double>(10, 3.0), {});
  for (const float weight : result.weights) EXPECT_EQ(weight, 0.5f);
  EXPECT_TRUE(make_weights({}, {}).weights.empty());
}

TEST(Steering, NumbersThatAreNotFiniteDoNotCount) {
  std::vector<double> numbers = up_to(100);
  numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  numbers.push_back(std::numeric_limits<double>::infinity());
  const auto with = make_weights(numbers, {});
  EXPECT_EQ(with.weights[101], 0.5f);
  EXPECT_EQ(with.weights[102], 0.5f);
  EXPECT_EQ(with.weights[20], make_weights(up_to(100), {}).weights[20]);
}

TEST(Steering, FrequenciesAreSpreadByTheirLogarithm) {
  const std::vector<float> weights{0.0f, 0.5f, 1.0f};
  const VertexNumber frequency = steer({4.0, 64.0}, Interpolation::logarithmic, weights);
  EXPECT_EQ(frequency.constant, 16.0);
  EXPECT_FLOAT_EQ(frequency.values[0], 4.0f);
  EXPECT_FLOAT_EQ(frequency.values[1], 16.0f);
  EXPECT_FLOAT_EQ(frequency.values[2], 64.0f);
  const VertexNumber falling = steer({3.0, 1.0}, Interpolation::linear, weights);
  EXPECT_FLOAT_EQ(falling.values[1], 2.0f);
  EXPECT_FALSE(steer({2.0, 2.0}, Interpolation::linear, weights).varies());
  EXPECT_EQ(steer({2.0, 2.0}, Interpolation::linear, weights).constant, 2.0);
}

TEST(Steering, TheHistogramHasEveryNumber) {
  const std::string text = draw_histogram(make_weights(up_to(999), {}), 40);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_NE(text.find("######"), std::string::npos);
}

TEST(Steering, RefusesWhatMakesNoSense) {
  EXPECT_EQ(message_of<std::invalid_argument>(
                [] { make_weights({}, {.low_percentile = 60.0, .high_percentile = 40.0}); }),
            "percentiles is 60 40; the first must be less than the second");
  EXPECT_THROW(make_weights({}, {.gamma = 0.0}), std::invalid_argument);
  EXPECT_THROW(make_weights({}, {.source = SteeringSource::attribute}), std::invalid_argument);
  EXPECT_THROW(make_weights({}, {.attribute = "heat"}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::steering_test
