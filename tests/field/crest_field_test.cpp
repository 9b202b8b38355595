#include "solidnoise/field/crest_field.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "support/message_of.h"

namespace solidnoise::crest_field_test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// height cos(2 pi F x), with its gradient.
class Wave final : public PointwiseField {
 public:
  Wave(double height, double frequency) : height_(height), frequency_(frequency) {}
  bool has_gradient() const override { return true; }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double phase = kTurn * frequency_ * points.positions[i].x;
      samples.values[i] = static_cast<float>(height_ * std::cos(phase));
      if (!samples.wants_gradient()) continue;
      samples.gradient[0][i] = static_cast<float>(-kTurn * frequency_ * height_ * std::sin(phase));
      samples.gradient[1][i] = samples.gradient[2][i] = 0.0f;
    }
  }

 private:
  double height_;
  double frequency_;
};

class Constant final : public PointwiseField {
 public:
  explicit Constant(float value) : value_(value) {}
  void evaluate(const Points<3>&, const Samples<3>& samples) const override {
    std::fill(samples.values.begin(), samples.values.end(), value_);
  }

 private:
  float value_;
};

Lattice<3> line() {
  Lattice<3> lattice;
  lattice.step = Vec<3>(0.01);
  lattice.count = {100, 1, 1};
  return lattice;
}

std::vector<float> values_on(const Field<3>& field, const Lattice<3>& lattice) {
  std::vector<float> values(lattice.size());
  field.block(lattice.bounds())->evaluate(lattice, {values, {}});
  return values;
}

// Whatever the height; in single precision, of which the gradient of a height of 100 has five digits.
TEST(CrestField, OfAWaveIsTheCosineOfItsPhase) {
  for (const double height : {0.01, 1.0, 100.0}) {
    const auto crest = crest_of(std::make_shared<Wave>(height, 3.0), 3.0);
    const auto values = values_on(*crest, line());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], std::cos(kTurn * 3.0 * line().coordinate(0, static_cast<std::int64_t>(i))),
                  1e-6);
    }
  }
}

TEST(CrestField, TakesTheFrequencyThatVaries) {
  const auto wave = std::make_shared<Wave>(1.0, 3.0);
  EXPECT_EQ(values_on(*crest_of(wave, 0.1, std::make_shared<Constant>(3.0f)), line()),
            values_on(*crest_of(wave, 3.0), line()));
}

TEST(CrestField, IsZeroWhereThereIsNothing) {
  const auto values = values_on(*crest_of(std::make_shared<Wave>(0.0, 3.0), 3.0), line());
  EXPECT_EQ(values, std::vector<float>(values.size(), 0.0f));
}

TEST(CrestField, IsTheSameAtPointsAndOnLattices) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 2.0, .direction = {1.0, 0.0, 0.0, 0.0}};
  const auto crest = crest_of(make_noise<3>(recipe), 2.0);
  Lattice<3> lattice;
  lattice.step = Vec<3>(0.03);
  lattice.count = {8, 8, 8};
  const std::vector<Vec<3>> positions = positions_of({&lattice, 1});
  std::vector<float> at_points(positions.size());
  crest->evaluate({positions}, {at_points, {}});
  const auto on_lattice = values_on(*crest, lattice);
  // The noise's own difference, 1e-4 of its deviation, over an amplitude that is rarely small.
  for (std::size_t i = 0; i < at_points.size(); ++i) EXPECT_NEAR(at_points[i], on_lattice[i], 5e-3);
}

std::vector<float> crests_of_noise(Layer::Histogram histogram, int octaves) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{
      .frequency = 1.0, .bandwidth = 0.3, .anisotropy = 1.0, .direction = {1.0, 0.0, 0.0, 0.0}};
  recipe.fractal.octaves = octaves;
  const auto field = make_layered_field({{.fold = Layer::Fold::crest, .histogram = histogram}}, recipe,
                                        [](const NoiseRecipe& of) { return make_noise<3>(of); });
  std::vector<Vec<3>> positions;
  for (int i = 0; i < 4000; ++i) positions.emplace_back(0.37 * i, 5.1 * (i % 17), 3.3 * (i % 29));
  std::vector<float> values(positions.size());
  field->evaluate({positions}, {values, {}});
  return values;
}

// The phase of a narrow band is uniform: evenly on 0 to 1, of mean 1/2 and variance 1/12. Samples are far
// apart or waves apart: 1000 of them count at least, so that 5 standard errors are 0.046 of the mean, and of
// the variance, whose standard error is sqrt(1/180 / 1000), 0.012; the band of 0.3 octaves adds below 0.01.
TEST(CrestField, RisesAndFallsEvenlyInAUniformHistogram) {
  const auto values = crests_of_noise(Layer::Histogram::uniform, 1);
  double mean = 0.0;
  double square = 0.0;
  for (const float value : values) {
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
    mean += value / static_cast<double>(values.size());
    square += value * value / static_cast<double>(values.size());
  }
  EXPECT_NEAR(mean, 0.5, 0.046);
  EXPECT_NEAR(square - mean * mean, 1.0 / 12.0, 0.022);
}

// Octaves of amplitudes 1, 1/2 and 1/4, over the root of the sum of their squares.
TEST(CrestField, OfOctavesIsTheirSum) {
  const double most = (1.0 + 0.5 + 0.25) / std::sqrt(1.0 + 0.25 + 0.0625);
  float highest = 0.0f;
  for (const float value : crests_of_noise(Layer::Histogram::gaussian, 3))
    highest = std::max(highest, std::abs(value));
  EXPECT_LE(highest, most + 1e-5);
  EXPECT_GT(highest, 0.9 * most);
}

TEST(CrestField, NeedsAGradient) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { crest_of(std::make_shared<Constant>(1.0f), 1.0); }),
            "crest needs a noise that has a gradient");
}

}  // namespace
}  // namespace solidnoise::crest_field_test
