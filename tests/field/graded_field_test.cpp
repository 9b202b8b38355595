#include "solidnoise/field/graded_field.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::graded_field_test {
namespace {

// From 1 to 16 cycles per unit: 2^(4 x) where x is from 0 to 1.
class Ramp final : public PointwiseField {
 public:
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      samples.values[i] = static_cast<float>(std::exp2(4.0 * points.positions[i].x));
  }
};

std::shared_ptr<const Noise<3>> gabor(double frequency, int grade) {
  return make_noise<3>(
      {.noise = GaborNoiseOptions{.frequency = frequency, .seed = 100 + static_cast<std::uint64_t>(grade)}});
}

FieldPtr graded() {
  return make_graded_field({std::make_shared<Ramp>(), 1.0, 16.0}, 1.0, gabor);
}

// With x as given, elsewhere far apart.
std::vector<Vec<3>> places(double x, int count) {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> anywhere(-1e4, 1e4);
  std::vector<Vec<3>> result;
  for (int i = 0; i < count; ++i) result.emplace_back(x, anywhere(engine), anywhere(engine));
  return result;
}

TEST(GradedField, AtTheFrequencyOfAGradeIsTheNoiseOfThatGrade) {
  for (const int grade : {0, 1, 4, 8}) {
    const double frequency = std::exp2(static_cast<double>(grade) / kGradesPerOctave);
    const auto positions = places(std::log2(frequency) / 4.0, 50);
    std::vector<float> values(50);
    std::vector<float> expected(50);
    graded()->evaluate({positions}, {values, {}});
    gabor(frequency, grade)->evaluate(Points<3>{positions}, {expected, {}});
    // The frequency is a float: 1e-7 of an octave between grades is their blend by 1e-14 of the other.
    for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(values[i], expected[i], 1e-5) << grade;
  }
}

// 20 000 independent places, excess kurtosis about 0: the variance's standard error is sqrt(2 / 20000), and
// that of a mean square slope over three axes at most as much; 5 of them are false in one of a million.
TEST(GradedField, HasUnitVarianceAndTheSlopesOfTheFrequencyThere) {
  constexpr int kCount = 20000;
  const double error = 5.0 * std::sqrt(2.0 / kCount);
  for (const double octaves : {0.0, 0.1, 0.25, 0.4, 1.7, 3.9}) {
    const auto positions = places(octaves / 4.0, kCount);
    std::vector<float> values(kCount);
    std::vector<std::vector<float>> slopes(3, std::vector<float>(kCount));
    graded()->evaluate({positions}, {values, {slopes[0], slopes[1], slopes[2]}});
    double square = 0.0;
    double slope = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
      square += values[i] * values[i] / kCount;
      for (const auto& derivative : slopes) slope += derivative[i] * derivative[i] / kCount;
    }
    EXPECT_NEAR(square, 1.0, error) << octaves;
    // That of a noise of this very frequency goes by its square, and the blend's is off by less than a
    // quarter octave: a factor of 2^(1/2).
    const Vec<3> exact = gabor(std::exp2(octaves), 0)->gradient_variance();
    EXPECT_LT(std::abs(std::log2(slope / (exact.x + exact.y + exact.z))), 0.5) << octaves;
  }
}

TEST(GradedField, AValueDependsOnItsPointOnly) {
  std::vector<Vec<3>> positions;
  for (const double x : {0.9, 0.1, 0.5, 0.33}) {
    for (const Vec<3>& place : places(x, 100)) positions.push_back(place);
  }
  std::vector<float> together(positions.size());
  graded()->evaluate({positions}, {together, {}});
  for (std::size_t i = 0; i < positions.size(); i += 37) {
    float alone = 0.0f;
    graded()->evaluate({{&positions[i], 1}}, {{&alone, 1}, {}});
    EXPECT_EQ(alone, together[i]);
  }
}

TEST(GradedField, KnowsItsBandFromTheLowestGradeToTheHighest) {
  const auto statistics = graded()->statistics();
  ASSERT_TRUE(statistics);
  EXPECT_EQ(statistics->variance, 1.0);
  EXPECT_EQ(statistics->band.lower, gabor(1.0, 0)->band().lower);
  EXPECT_EQ(statistics->band.upper, gabor(16.0 * std::sqrt(2.0), 0)->band().upper);
}

}  // namespace
}  // namespace solidnoise::graded_field_test
