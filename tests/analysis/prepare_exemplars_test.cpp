#include "solidnoise/analysis/exemplar/prepare_exemplars.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/image/color.h"

namespace solidnoise::prepare_exemplars_test {
namespace {

// Independent normal values.
Exemplar<2> normal_values(double mean, double sigma) {
  std::mt19937 engine(7);
  std::normal_distribution<double> values(mean, sigma);
  DenseField<2> field(glm::ivec2(64), Vec<2>(1.0));
  for (float& value : field.values) value = static_cast<float>(values(engine));
  return {{field}};
}

Exemplar<2> encoded(Exemplar<2> linear) {
  for (float& value : linear.channels.front().values) value = srgb_from_linear(value);
  return linear;
}

// 4096 values: the skewness of normal ones scatters by sqrt(6 / 4096) = .04.
TEST(ChooseValues, TakesThoseThatAreNormal) {
  const Exemplar<2> normal = normal_values(0.5, 0.12);
  std::vector<Exemplar<2>> stored{normal};
  const ValueChoice raw = choose_values(stored, {false});
  EXPECT_TRUE(raw.raw_values);
  EXPECT_EQ(stored.front().channels.front().values, normal.channels.front().values);
  EXPECT_NEAR(raw.fit.skewness, 0.0, 0.2);
  EXPECT_NEAR(raw.fit.clipped, std::erfc(0.5 / (0.12 * std::sqrt(2.0))), 2e-5);

  std::vector<Exemplar<2>> photograph{encoded(normal)};
  const ValueChoice linear = choose_values(photograph, {false});
  EXPECT_FALSE(linear.raw_values);
  EXPECT_NEAR(linear.fit.skewness, 0.0, 0.2);
  for (std::size_t i = 0; i < normal.shape().size(); ++i) {
    ASSERT_NEAR(photograph.front().channels.front().values[i], normal.channels.front().values[i], 1e-5);
  }
}

// Such as a lawn: dark, with bright blades. Of a noise as lopsided as normal values, 4 % would be below 0.
TEST(ChooseValues, TakesSquaresOfWhatIsDarkWithBrightParts) {
  std::vector<Exemplar<2>> lawn{normal_values(0.35, 0.15)};
  for (float& value : lawn.front().channels.front().values) value *= value;
  const Exemplar<2> before = lawn.front();
  EXPECT_GT(fit_of_values(lawn).clipped, 0.04);
  const ValueChoice choice = choose_values(lawn, {false});
  EXPECT_TRUE(choice.squares);
  EXPECT_TRUE(choice.raw_values);
  EXPECT_EQ(lawn.front().channels.front().values, before.channels.front().values);
  EXPECT_LT(choice.fit.clipped, 1e-4);
  EXPECT_LT(std::abs(choice.fit.skewness), 0.3);
  EXPECT_FALSE(choose_values(lawn, {true}).squares);

  // A few bright spots on black: no squares of normal values vary as much.
  std::vector<Exemplar<2>> spots = {before};
  std::vector<float>& values = spots.front().channels.front().values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 16 == 0 ? 0.9f : 0.01f;
  EXPECT_FALSE(are_squares(spots));
  EXPECT_FALSE(choose_values(spots, {false}).squares);
  // Nor values below 0, nor pictures that are dark but for one, though each alone is.
  std::vector<Exemplar<2>> negative = {before};
  negative.front().channels.front().values.front() = -0.1f;
  EXPECT_FALSE(are_squares(negative));
  std::vector<Exemplar<2>> pictures(12, before);
  for (Exemplar<2>& dark : pictures) {
    for (float& value : dark.channels.front().values) value *= &dark == pictures.data() ? 5.0f : 0.02f;
    EXPECT_TRUE(are_squares(std::span(&dark, 1)));
  }
  EXPECT_FALSE(are_squares(pictures));
  EXPECT_FALSE(choose_values(lawn, {false}, false).squares);
  // Of values all over the range squares are clipped hardly less.
  std::vector<Exemplar<2>> even = {before};
  std::vector<float>& all_over = even.front().channels.front().values;
  for (std::size_t i = 0; i < all_over.size(); ++i)
    all_over[i] = static_cast<float>(i) / static_cast<float>(all_over.size());
  EXPECT_FALSE(choose_values(even, {false}).squares);
}

TEST(ChooseValues, TakesLinearLightWhereOneHoldsItAlready) {
  const Exemplar<2> normal = normal_values(0.5, 0.12);
  std::vector<Exemplar<2>> both{normal, encoded(normal)};
  EXPECT_FALSE(choose_values(both, {true, false}).raw_values);
  EXPECT_EQ(both.front().channels.front().values, normal.channels.front().values);
  for (std::size_t i = 0; i < normal.shape().size(); ++i) {
    ASSERT_NEAR(both.back().channels.front().values[i], normal.channels.front().values[i], 1e-5);
  }
}

}  // namespace
}  // namespace solidnoise::prepare_exemplars_test
