#include "solidnoise/analysis/exemplar/square_colors.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/edit_model.h"
#include "solidnoise/analysis/exemplar/edit_spectrum.h"

namespace solidnoise::square_colors_test {
namespace {

TEST(RootMoments, AreThoseOfTheNormalValuesWhoseSquaresAreMeant) {
  for (const auto& [mean, deviation] : {std::pair{0.5, 0.1}, {0.3, 0.2}, {0.05, 0.2}, {0.0, 0.3}}) {
    const double variance = deviation * deviation;
    const RootMoments root =
        root_moments(mean * mean + variance, 2.0 * variance * variance + 4.0 * mean * mean * variance);
    EXPECT_NEAR(root.mean, mean, 1e-7);
    EXPECT_NEAR(root.variance, variance, 1e-12);
  }
  // More lopsided than squares are.
  EXPECT_EQ(root_moments(0.1, 0.05).mean, 0.0);
  EXPECT_EQ(root_moments(0.1, 0.05).variance, 0.1);
  EXPECT_DOUBLE_EQ(reached_share(0.1, 0.05), 0.4);
  EXPECT_EQ(root_moments(-0.1, 0.05).variance, 0.0);
}

GaborSpectrum of_variance(double variance) {
  GaborSpectrum spectrum;
  spectrum.bands = {{0.1, {{{0.2, 0.0, 0.0}, variance}}}};
  return spectrum;
}

// Means, and covariances row by row, of the colours that a model makes of normal values, with what a filter
// leaves of them.
SampleMoments measured(const ExemplarModel& model, int count, double left = 1.0) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Vec<3>> colors;
  std::vector<double> values(model.channels.size());
  const ChannelColors color_of(model, std::vector(values.size(), left * left));
  for (int i = 0; i < count; ++i) {
    for (double& value : values) value = left * normal(engine);
    colors.push_back(color_of(values));
  }
  SampleMoments moments{std::vector<double>(3), std::vector<double>(9)};
  for (const Vec<3>& color : colors) {
    for (int i = 0; i < 3; ++i) moments.mean[static_cast<std::size_t>(i)] += color[i] / count;
  }
  for (const Vec<3>& color : colors) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        moments.covariance[3 * i + j] += (color[static_cast<int>(i)] - moments.mean[i]) *
                                         (color[static_cast<int>(j)] - moments.mean[j]) / count;
      }
    }
  }
  return moments;
}

// 400 000 samples: a mean scatters by 1/630 of a deviation, a covariance, of values whose kurtosis is below
// 8, by less than 1/200 of the product of two. Of 12 numbers beyond 5 deviations: once in 150 000 runs.
TEST(SquareColors, HaveTheMeansAndCovariancesThatAreWanted) {
  const SampleMoments wanted{{0.25, 0.32, 0.12},
                             {0.030, 0.024, 0.010, 0.024, 0.028, 0.009, 0.010, 0.009, 0.012}};
  ExemplarModel model;
  model.channels = {of_variance(0.02), of_variance(0.005), of_variance(0.001)};
  model.axes = {{0.7, 0.6, 0.2}, {0.5, -0.7, 0.3}, {0.1, 0.0, 1.0}};
  model.mean = {0.5, 0.5, 0.3};
  square_colors(model, wanted);
  EXPECT_TRUE(model.squares);
  const SampleMoments made = measured(model, 400000);
  for (std::size_t i = 0; i < 3; ++i) {
    const double deviation = std::sqrt(wanted.covariance[4 * i]);
    EXPECT_NEAR(made.mean[i], wanted.mean[i], 5.0 / 630.0 * deviation);
    for (std::size_t j = 0; j < 3; ++j) {
      const double scale = deviation * std::sqrt(wanted.covariance[4 * j]);
      EXPECT_NEAR(made.covariance[3 * i + j], wanted.covariance[3 * i + j], 5.0 / 200.0 * scale);
    }
  }
}

ExemplarModel some_squares() {
  ExemplarModel model;
  model.channels = {of_variance(0.02), of_variance(0.005), of_variance(0.001)};
  model.axes = {{0.7, 0.6, 0.2}, {0.5, -0.7, 0.3}, {0.1, 0.0, 1.0}};
  model.mean = {0.4, 0.5, 0.2};
  model.squares = true;
  return model;
}

// However much a filter takes, a picture stays as bright.
TEST(SquareColors, KeepTheirMeanUnderAFilter) {
  const ExemplarModel model = some_squares();
  for (const double left : {1.0, 0.5, 0.0}) {
    const SampleMoments made = measured(model, 400000, left);
    for (std::size_t i = 0; i < 3; ++i) {
      const double deviation = std::sqrt(made.covariance[4 * i]);
      EXPECT_NEAR(made.mean[i], model.mean_color()[static_cast<int>(i)], 5.0 / 630.0 * deviation + 1e-12);
    }
  }
}

TEST(SquareColors, KeepTheirMeanWhenTheyAreEdited) {
  const ExemplarModel model = some_squares();
  for (const double by : {0.3, 1.2}) {
    ExemplarModel edited = model;
    edit_model(edited, {},
               [&](GaborSpectrum& spectrum, std::size_t) { scale_magnitude(spectrum, std::nullopt, by); });
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(edited.mean_color()[i], model.mean_color()[i], 1e-12);
  }
}

// Blue has rare bright spots: it keeps its mean, and the others what they are.
TEST(SquareColors, KeepWhatTheyCanOfWhatIsMoreLopsided) {
  const SampleMoments wanted{{0.2, 0.2, 0.03},
                             {0.015, 0.013, 0.004, 0.013, 0.015, 0.004, 0.004, 0.004, 0.03}};
  ExemplarModel model = some_squares();
  square_colors(model, wanted);
  const SampleMoments made = measured(model, 400000);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(made.mean[i], wanted.mean[i], 5.0 / 630.0 * std::sqrt(made.covariance[4 * i]));
    const double variance = i == 2 ? 2.0 * 0.03 * 0.03 : wanted.covariance[4 * i];
    EXPECT_NEAR(made.covariance[4 * i], variance, 5.0 / 150.0 * variance);
  }
}

TEST(SquareColors, OfGreyAreGrey) {
  ExemplarModel model;
  model.channels = {of_variance(0.04)};
  square_colors(model, {{0.2}, {0.02}});
  const SampleMoments made = measured(model, 400000);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(made.mean[i], 0.2, 5.0 / 630.0 * std::sqrt(0.02));
    EXPECT_NEAR(made.covariance[4 * i], 0.02, 5.0 / 200.0 * 0.02);
  }
  model.channels = {of_variance(0.04)};
  square_colors(model, {{0.029}, {0.03}});
  EXPECT_NEAR(model.mean_color().x, 0.029, 1e-12);
}

TEST(SquareColors, RootsOfNegativeValuesAreZero) {
  const DenseField<2> field{glm::ivec2(1, 2), Vec<2>(1.0)};
  std::vector<Exemplar<2>> exemplars{{{field}}};
  exemplars.front().channels.front().values = {-0.5f, 0.25f};
  const auto roots = square_roots(std::span<const Exemplar<2>>(exemplars));
  EXPECT_EQ(roots.front().channels.front().values, (std::vector<float>{0.0f, 0.5f}));
  EXPECT_EQ(squared(roots.front()).channels.front().values, (std::vector<float>{0.0f, 0.25f}));
}

}  // namespace
}  // namespace solidnoise::square_colors_test
