#include "solidnoise/analysis/periodogram.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "analysis/synthetic_fields.h"
#include "support/welch_spectrum.h"

namespace solidnoise::periodogram_test {
namespace {

TEST(Periodogram, WithoutAWindowAddsUpToTheMeanSquare) {
  const DenseField<3> field = white_field<3>({8, 9, 10}, {0.5, 0.25, 2.0}, 1);
  double sum = 0.0;
  for (const float value : field.values) sum += static_cast<double>(value) * value;

  const PowerSpectrum<3> spectrum = periodogram(field, {.window = Window::none});

  // Parseval's equation, in double precision.
  const double mean_square = sum / static_cast<double>(field.size());
  EXPECT_NEAR(spectrum.variance(), mean_square, 1e-12 * mean_square);
}

TEST(Periodogram, OfAWaveHasItsPowerAtItsFrequency) {
  DenseField<2> field({32, 20}, {0.1, 0.2});
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const glm::ivec2 at = ArrayShape<2>{field.count}.position(i);
    // 5 and -3 periods over the block: frequency (5 / 3.2, -3 / 4).
    field.values[i] =
        static_cast<float>(std::cos(2.0 * std::numbers::pi * (5.0 * at.x / 32.0 - 3.0 * at.y / 20.0)));
  }

  const PowerSpectrum<2> spectrum = periodogram(field, {.window = Window::none});

  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<2> f = spectrum.frequency(i);
    const bool peak = std::abs(std::abs(f.x) - 5.0 / 3.2) < 1e-9 && std::abs(std::abs(f.y) - 0.75) < 1e-9 &&
                      f.x * f.y < 0.0;
    // Half of the variance 1/2 at each of f and -f; float samples are 6e-8 off.
    EXPECT_NEAR(spectrum.density[i] * spectrum.cell(), peak ? 0.25 : 0.0, 1e-7);
  }
}

TEST(Periodogram, SubtractsTheMeanItIsGiven) {
  DenseField<1> field(glm::vec<1, int>(16), Vec<1>(1.0));
  for (float& value : field.values) value = 2.5f;
  EXPECT_EQ(periodogram(field, {.mean = 2.5}).variance(), 0.0);
  EXPECT_GT(periodogram(field).variance(), 1.0);
}

TEST(Periodogram, WelchBlocksOfAFieldAreItsParts) {
  const DenseField<2> field = white_field<2>({8, 12}, {1.0, 1.0}, 4);
  PeriodogramAverage<2> average({8, 8}, {1.0, 1.0});
  for (const int first : {0, 4}) {
    DenseField<2> part({8, 8}, {1.0, 1.0});
    for (std::size_t i = 0; i < part.values.size(); ++i) {
      const glm::ivec2 at = ArrayShape<2>{part.count}.position(i);
      part.values[i] = field.values[static_cast<std::size_t>(at.x * 12 + at.y + first)];
    }
    average.add(part.values);
  }

  EXPECT_EQ(welch_spectrum(field, {8, 8}).density, average.spectrum().density);
}

TEST(Periodogram, OverlapCountsForLessThanIndependentBlocks) {
  const DenseField<1> field = white_field<1>(glm::vec<1, int>(640), Vec<1>(1.0), 4);

  const PowerSpectrum<1> spectrum = welch_spectrum(field, glm::vec<1, int>(64));

  // 19 blocks, neighbours correlated by 1/36 (Hann windows shifted by half: 1/6 in amplitude).
  EXPECT_NEAR(spectrum.independent_blocks, 19.0 * 19.0 / (19.0 + 2.0 * 18.0 / 36.0), 1e-9);
}

TEST(Periodogram, RefusesBlocksThatAreNone) {
  const DenseField<1> field = white_field<1>(glm::vec<1, int>(16), Vec<1>(1.0), 4);
  EXPECT_THROW(PeriodogramAverage<1>(glm::vec<1, int>(1), Vec<1>(1.0)), std::invalid_argument);
  EXPECT_THROW(PeriodogramAverage<1>(glm::vec<1, int>(8), Vec<1>(0.0)), std::invalid_argument);
  PeriodogramAverage<1> average(glm::vec<1, int>(8), Vec<1>(1.0));
  EXPECT_THROW(average.add(field.values), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::periodogram_test
