#include "solidnoise/analysis/moments.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/synthetic_fields.h"

namespace solidnoise {
namespace {

TEST(Moments, OfAFewValuesAreTheirFormulas) {
  // Values 0, 0, 0, 1: mean 1/4, variance 3/16, third and fourth central moments 6/64 and 21/256.
  const SampleMoments moments = measure_moments(std::vector<float>{0.0f, 0.0f, 0.0f, 1.0f});

  EXPECT_EQ(moments.count, 4);
  EXPECT_EQ(moments.minimum, 0.0);
  EXPECT_EQ(moments.maximum, 1.0);
  EXPECT_DOUBLE_EQ(moments.mean, 0.25);
  EXPECT_DOUBLE_EQ(moments.variance, 3.0 / 16.0);
  EXPECT_NEAR(moments.skewness, 6.0 / 64.0 / std::pow(3.0 / 16.0, 1.5), 1e-12);
  EXPECT_NEAR(moments.excess_kurtosis, 21.0 / 256.0 / (9.0 / 256.0) - 3.0, 1e-12);
}

TEST(Moments, OfNothingAndOfAConstantAreFinite) {
  EXPECT_EQ(measure_moments({}).count, 0);
  const SampleMoments moments = measure_moments(std::vector<float>(5, 3.0f));
  EXPECT_EQ(moments.mean, 3.0);
  EXPECT_EQ(moments.variance, 0.0);
  EXPECT_EQ(moments.skewness, 0.0);
  EXPECT_EQ(moments.excess_kurtosis, 0.0);
}

TEST(Moments, OfAGaussianSampleAreWithinFourStandardErrors) {
  const DenseField<1> field = white_field<1>(glm::vec<1, int>(100000), Vec<1>(1.0), 5);
  const double n = 1e5;

  const SampleMoments moments = measure_moments(field.values);

  EXPECT_NEAR(moments.mean, 0.0, 4.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(moments.variance, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(moments.skewness, 0.0, 4.0 * std::sqrt(6.0 / n));
  EXPECT_NEAR(moments.excess_kurtosis, 0.0, 4.0 * std::sqrt(24.0 / n));
}

TEST(Histogram, CountsEveryValueOnce) {
  const std::vector<float> values{-5.0f, -4.0f, -0.1f, 0.0f, 0.1f, 3.9f, 4.0f};
  const SampleHistogram histogram =
      measure_histogram(values, {.mean = 0.0, .sigma = 1.0, .reach = 4.0, .bins = 2});

  EXPECT_EQ(histogram.below, 1);
  EXPECT_EQ(histogram.counts, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(histogram.above, 1);
}

TEST(Histogram, OfAGaussianSampleMatchesTheGaussianCounts) {
  const DenseField<1> field = white_field<1>(glm::vec<1, int>(100000), Vec<1>(1.0), 9);
  const SampleHistogram histogram = measure_histogram(field.values, {.bins = 32});

  // The bins within 3 sigma hold at least 80 values each: binomial counts, near enough to a Gaussian for
  // 4.5 standard deviations to be exceeded by one of 24 bins once in 6000 runs.
  for (std::size_t bin = 4; bin < 28; ++bin) {
    const double expected = histogram.gaussian_counts[bin];
    EXPECT_NEAR(static_cast<double>(histogram.counts[bin]), expected, 4.5 * std::sqrt(expected)) << bin;
  }
}

TEST(Histogram, RefusesBadOptions) {
  EXPECT_THROW(measure_histogram({}, {.sigma = 0.0}), std::invalid_argument);
  EXPECT_THROW(measure_histogram({}, {.bins = 0}), std::invalid_argument);
  EXPECT_THROW(measure_histogram({}, {.mean = NAN}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise
