#include "solidnoise/field/derived_fields.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/spectra.h"
#include "support/vector_fields.h"

namespace solidnoise::derived_fields_test {
namespace {

Lattice<3> some_lattice() {
  Lattice<3> lattice;
  lattice.step = Vec<3>(0.11);
  lattice.first = Index<3>(-7, 2, 0);
  lattice.count = {12, 9, 11};
  return lattice;
}

TEST(GradientField, HasTheNoisesValueAndDerivativesToTheBit) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0};
  recipe.fractal.octaves = 2;
  const std::shared_ptr<const Noise<3>> noise = make_noise<3>(recipe);
  const Lattice<3> lattice = some_lattice();
  const std::size_t size = lattice.size();
  const Evaluated<3> expected = evaluate_in_one_block<3>(*noise, lattice);

  const auto alone = gradient_of(noise);
  const auto after = value_and_gradient_of(noise);
  ASSERT_EQ(alone->channels(), 3);
  ASSERT_EQ(after->channels(), 4);
  const auto values_alone = channels_on(*alone, lattice);
  const auto values_after = channels_on(*after, lattice);
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_EQ(values_after[i], expected.values[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(values_alone[axis * size + i], expected.gradient[axis][i]);
      EXPECT_EQ(values_after[(1 + axis) * size + i], expected.gradient[axis][i]);
    }
  }
}

// Without the values it is what it is beside them, of fields too that need them to make it.
TEST(GradientField, IsTheSameWithoutTheValues) {
  const auto noise = [](std::uint64_t seed) {
    NoiseRecipe recipe;
    recipe.noise = GaborNoiseOptions{.frequency = 1.0, .seed = seed};
    return std::shared_ptr<const Noise<3>>(make_noise<3>(recipe));
  };
  NoiseRecipe oriented;
  oriented.noise = OrientedGaborNoiseOptions{.frequency = 1.0};
  const Lattice<3> lattice = some_lattice();
  const LatticeFrame<3> frame{lattice.origin, lattice.step};
  const auto long_waves = [&](Quantity quantity) {
    NoiseRecipe recipe;
    recipe.noise = GaborNoiseOptions{.frequency = 0.25};
    const std::shared_ptr<const Noise<3>> direct = make_noise<3>(recipe);
    const auto interpolated = interpolate<3>(direct, frame, 0.02, quantity);
    EXPECT_NE(interpolated, direct);
    return interpolated;
  };
  const auto combined = [&](Layer::Combine how) {
    return combine(how, {noise(1), absolute(noise(2), 1.5), noise(3)});
  };
  const std::vector<std::pair<std::string, FieldPtr>> fields{
      {"noise", noise(1)},
      {"oriented", make_noise<3>(oriented)},
      {"interpolated", long_waves(Quantity::values)},
      {"interpolated gradient", long_waves(Quantity::gradient)},
      {"absolute", absolute(noise(1), 1.0)},
      {"stretched", stretched(absolute(noise(1), 1.0), Vec<3>(1.0, 2.0, 3.0))},
      {"sum", combined(Layer::Combine::sum)},
      {"product", combined(Layer::Combine::product)},
      {"max", combined(Layer::Combine::max)},
      {"mix", combined(Layer::Combine::mix)},
  };
  const std::vector<Vec<3>> places = positions_of({&lattice, 1});
  for (const auto& [name, field] : fields) {
    SCOPED_TRACE(name);
    const auto alone = gradient_of(field);
    const auto after = value_and_gradient_of(field);
    const std::size_t size = lattice.size();
    const auto at_points = [&](const Field<3>& of) {
      std::vector<float> values(static_cast<std::size_t>(of.channels()) * size);
      of.evaluate({places}, {values});
      return values;
    };
    const auto gradient_in = [&](const std::vector<float>& channels) {
      return std::vector<float>(channels.begin() + static_cast<std::ptrdiff_t>(size), channels.end());
    };
    EXPECT_EQ(channels_on(*alone, lattice), gradient_in(channels_on(*after, lattice)));
    EXPECT_EQ(at_points(*alone), gradient_in(at_points(*after)));
  }
}

TEST(PhasorField, HasTheNoiseAsItsRealPart) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 1.0, .anisotropy = 1.0};
  const std::shared_ptr<const Noise<3>> noise = make_noise<3>(recipe);
  const std::shared_ptr<const Noise<3>> quadrature = make_quadrature<3>(recipe);
  const auto field = phasor_of(noise, quadrature);
  const Lattice<3> lattice = some_lattice();
  const std::size_t size = lattice.size();
  const auto real = evaluate_in_one_block<3>(*noise, lattice).values;
  const auto imaginary = evaluate_in_one_block<3>(*quadrature, lattice).values;
  const auto values = channels_on(*field, lattice);
  for (std::size_t i = 0; i < size; ++i) {
    const double phase = values[i];
    const double intensity = values[size + i];
    EXPECT_LE(std::abs(phase), std::numbers::pi + 1e-6);
    EXPECT_NEAR(std::numbers::sqrt2 * intensity * std::cos(phase), real[i], 2e-6);
    EXPECT_NEAR(std::numbers::sqrt2 * intensity * std::sin(phase), imaginary[i], 2e-6);
  }
}

// Along the waves of a single direction the phase advances by 2 pi F a unit, up to what the impulses'
// envelopes add, which is 0 on average: over many places the mean of the turn is the wave's.
TEST(PhasorField, PhaseTravelsWithTheWaves) {
  constexpr double kFrequency = 1.0;
  constexpr double kStep = 0.05;
  NoiseRecipe recipe;
  recipe.noise =
      OrientedGaborNoiseOptions{.frequency = kFrequency, .bandwidth = 0.5, .impulses = 40, .anisotropy = 1.0};
  const auto field = phasor_of(make_noise<3>(recipe), make_quadrature<3>(recipe));
  Lattice<3> lattice;
  lattice.step = {kStep, 1.0, 1.0};
  lattice.count = {2, 30, 30};
  const auto phase = channels_on(*field, lattice);
  double sum = 0.0;
  for (std::size_t i = 0; i < 900; ++i) {
    sum += std::remainder(phase[900 + i] - phase[i], 2.0 * std::numbers::pi);
  }
  // The turn is 0.314 on average; its spread over places, from the band of half an octave, is under 0.15,
  // heavy-tailed near zeros of the intensity; 900 places with neighbours alike: 4 times 0.15 / sqrt(300).
  EXPECT_NEAR(sum / 900.0, 2.0 * std::numbers::pi * kFrequency * kStep, 0.035);
}

TEST(PhasorField, IntensityHasUnitMeanSquareAndTheMeanOfRayleigh) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 1.0, .impulses = 60};
  const auto field = phasor_of(make_noise<3>(recipe), make_quadrature<3>(recipe));
  Lattice<3> lattice;
  lattice.count = {20, 20, 20};
  double sum = 0.0;
  double squares = 0.0;
  const std::vector<float> values = channels_on(*field, lattice);
  for (const float value : std::span(values).subspan(8000)) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  // |z|^2 / 2 is exponential, of standard deviation 1; samples a wave apart, some 5000 of them independent.
  EXPECT_NEAR(squares / 8000.0, 1.0, 4.0 / std::sqrt(5000.0));
  EXPECT_NEAR(sum / 8000.0, 0.5 * std::sqrt(std::numbers::pi), 4.0 * 0.46 / std::sqrt(5000.0));
}

// The largest correlation of two channels over all shifts of a periodic tile: 1 if they were one field,
// however moved.
TEST(SideBySide, HasIndependentChannelsAlsoWhenPeriodic) {
  for (const bool lattice_noise : {false, true}) {
    NoiseRecipe recipe;
    if (lattice_noise) {
      recipe.noise = GradientNoiseOptions{.frequency = 1.0, .period = {8.0, 8.0, 8.0, 0.0}};
    } else {
      recipe.noise = GaborNoiseOptions{.frequency = 1.0, .period = {8.0, 8.0, 8.0, 0.0}};
    }
    std::vector<FieldPtr> noises;
    for (int c = 0; c < 3; ++c) noises.push_back(make_noise<3>(channel_of(recipe, c)));
    const auto field = side_by_side(noises);
    constexpr int kSide = 16;
    constexpr std::size_t kSize = kSide * kSide * kSide;
    Lattice<3> lattice;
    lattice.step = Vec<3>(0.5);
    lattice.count = {kSide, kSide, kSide};
    const auto values = channels_on(*field, lattice);
    const auto correlation = [&](const float* a, const float* b, int di, int dj, int dk) {
      double ab = 0.0;
      double aa = 0.0;
      double bb = 0.0;
      std::size_t sample = 0;
      for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
          for (int k = 0; k < kSide; ++k, ++sample) {
            const int other = ((i + di) % kSide * kSide + (j + dj) % kSide) * kSide + (k + dk) % kSide;
            ab += a[sample] * b[other];
            aa += a[sample] * a[sample];
            bb += b[other] * b[other];
          }
        }
      }
      return ab / std::sqrt(aa * bb);
    };
    const auto largest = [&](const float* a, const float* b) {
      double found = 0.0;
      for (int shift = 0; shift < static_cast<int>(kSize); shift += 3) {
        found = std::max(found, std::abs(correlation(a, b, shift / 256, shift / 16 % 16, shift % 16)));
      }
      return found;
    };
    const float* const first = values.data();
    EXPECT_NEAR(correlation(first, first, 0, 0, 0), 1.0, 1e-12);
    // Of the order of 500 independent waves in a tile: each correlation is about 1 / sqrt(500) = 0.045, the
    // largest of a thousand about 4 of them.
    EXPECT_LT(largest(first, first + kSize), 0.35);
    EXPECT_LT(largest(first, first + 2 * kSize), 0.35);
    EXPECT_LT(largest(first + kSize, first + 2 * kSize), 0.35);
  }
}

TEST(ExemplarColors, AreTheMeanAndTheChannelsAlongTheirAxes) {
  ExemplarModel model = some_spectrum(3).model;
  for (SpectrumBand& band : model.channels[0].bands) {
    for (SpectrumComponent& component : band.components) component.variance *= 4.0;
  }
  model.channels.resize(3, model.channels[0]);
  model.axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.5}, {0.2, 0.0, 1.0}};
  model.mean = {0.5, 0.4, 0.3};
  const NoiseRecipe recipe{SpectrumNoiseOptions{.model = model}, {}};
  std::vector<std::shared_ptr<const Noise<3>>> noises;
  for (int k = 0; k < 3; ++k) noises.push_back(make_noise<3>(channel_of(recipe, k)));
  const Lattice<3> lattice = some_lattice();
  const std::size_t size = lattice.size();
  const auto colors = channels_on(*exemplar_colors_of({noises.begin(), noises.end()}, model), lattice);
  std::vector<Evaluated<3>> n;
  for (const auto& noise : noises) n.push_back(evaluate_in_one_block<3>(*noise, lattice));
  for (std::size_t i = 0; i < size; ++i) {
    // The standard deviation of each channel is 2: its spectrum's variance is 4.
    EXPECT_NEAR(colors[i], 0.5 + 2.0 * n[0].values[i] + 0.4 * n[2].values[i], 1e-5);
    EXPECT_NEAR(colors[size + i], 0.4 + 2.0 * n[1].values[i], 1e-5);
    EXPECT_NEAR(colors[2 * size + i], 0.3 + 1.0 * n[1].values[i] + 2.0 * n[2].values[i], 1e-5);
  }
}

}  // namespace
}  // namespace solidnoise::derived_fields_test
