#include "solidnoise/noise/gradient/gradient_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/each_dimension.h"
#include "support/gradient_noises.h"
#include "support/message_of.h"
#include "support/simd_targets.h"

namespace solidnoise::gradient_noise_test {
namespace {

// Bound of the error of a value, in standard deviations of the noise: the magnitudes of the terms add up to
// 13 at most (in 4D: the bound 3.49 over the standard deviation 0.27), and each has fewer than 10 roundings
// of 2^-24.
constexpr double kValueBound = 8e-6;

// The same for derivatives, in units of 2 pi times the frequency.
constexpr double kDerivativeBound = 8e-6;

// A lattice of odd counts, about 11 samples per lattice unit, that crosses 0.
template <int Dim>
Lattice<Dim> some_lattice(const GradientNoise<Dim>& noise) {
  Lattice<Dim> lattice;
  constexpr std::array<int, 4> kCount = {41, 21, 13, 7};
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.origin[axis] = 0.013 * axis;
    lattice.step[axis] = noise.lattice_spacing()[axis] / (11.0 + 0.7 * axis);
    lattice.first[axis] = -6 - axis;
    lattice.count[axis] = kCount[Dim - 1] + axis;
  }
  return lattice;
}

// Every sample of a lattice agrees with the reference.
template <int Dim>
void expect_agreement(const GradientNoise<Dim>& noise, const Lattice<Dim>& lattice) {
  const ReferenceNoise<Dim> reference(noise);
  const Evaluated<Dim> result = evaluate_in_one_block(noise, lattice);
  const double slope = 2.0 * std::numbers::pi * noise.options().frequency;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec<Dim> position = sample_position(lattice, i);
    ASSERT_NEAR(result.values[i], reference.value(position), kValueBound) << "sample " << i;
    for (int axis = 0; axis < Dim; ++axis) {
      ASSERT_NEAR(result.gradient[static_cast<std::size_t>(axis)][i], reference.derivative(position, axis),
                  kDerivativeBound * slope)
          << "sample " << i << ", axis " << axis;
    }
  }
}

TEST(GradientNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  for_each_simd_target([](std::int64_t) {
    for_each_dimension([]<int Dim>() {
      for_each_gradient_noise([](const GradientNoiseOptions& options) {
        const GradientNoise<Dim> noise(options);
        expect_agreement(noise, some_lattice(noise));
      });
    });
  });
}

TEST(GradientNoise, AgreesWithTheReferenceFarFromTheOrigin) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](const GradientNoiseOptions& options) {
      const GradientNoise<Dim> noise(options);
      Lattice<Dim> lattice = some_lattice(noise);
      for (int axis = 0; axis < Dim; ++axis) lattice.origin[axis] = axis % 2 == 0 ? 1e6 : -1e6;
      expect_agreement(noise, lattice);
    });
  });
}

TEST(GradientNoise, AgreesWithTheReferenceAtLatticePointsAndCoarseSteps) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](const GradientNoiseOptions& options) {
      const GradientNoise<Dim> noise(options);
      // Steps of a half, of a whole and of more lattice units than a kernel is wide.
      for (const double units : {0.5, 1.0, 5.25}) {
        Lattice<Dim> lattice = some_lattice(noise);
        for (int axis = 0; axis < Dim; ++axis) {
          lattice.origin[axis] = 0.0;
          lattice.step[axis] = units * noise.lattice_spacing()[axis];
          lattice.count[axis] = Dim == 4 ? 4 : 9;
        }
        expect_agreement(noise, lattice);
      }
    });
  });
}

TEST(GradientNoise, IsBitIdenticalOnInstructionSetsWithFusedMultiplyAdd) {
  for_each_dimension([]<int Dim>() {
    const GradientNoise<Dim> noise(GradientNoiseOptions{});
    const Lattice<Dim> lattice = some_lattice(noise);
    std::vector<Evaluated<Dim>> results;
    for_each_simd_target([&](std::int64_t target) {
      if ((target & (HWY_AVX3 | HWY_AVX2)) != 0) results.push_back(evaluate_in_one_block(noise, lattice));
    });
    for (const auto& result : results) EXPECT_EQ(result, results.front());
  });
}

TEST(GradientNoise, IsBitIdenticalWithAndWithoutGradient) {
  for_each_dimension([]<int Dim>() {
    const GradientNoise<Dim> noise(GradientNoiseOptions{});
    const Lattice<Dim> lattice = some_lattice(noise);
    std::vector<float> values(lattice.size());
    noise.block(lattice.bounds())->evaluate(lattice, Samples<Dim>{values, {}});
    EXPECT_EQ(values, evaluate_in_one_block(noise, lattice).values);
  });
}

TEST(GradientNoise, IsBitIdenticalWhereverABoxIsCut) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](const GradientNoiseOptions& options) {
      const GradientNoise<Dim> noise(options);
      const Lattice<Dim> whole = some_lattice(noise);
      const Evaluated<Dim> expected = evaluate_in_one_block(noise, whole);
      for (int axis = 0; axis < Dim; ++axis) {
        // Cut at a place that no tile's border falls on, and evaluate each part in a block of its own.
        const int cut = whole.count[axis] / 2 + 1;
        for (const bool upper : {false, true}) {
          Lattice<Dim> part = whole;
          part.first[axis] += upper ? cut : 0;
          part.count[axis] = upper ? whole.count[axis] - cut : cut;
          const Evaluated<Dim> result = evaluate_in_one_block(noise, part);
          for (std::size_t i = 0; i < part.size(); ++i) {
            // Where the part's sample is in the whole.
            std::size_t rest = i;
            std::size_t index = 0;
            std::size_t stride = 1;
            for (int a = Dim - 1; a >= 0; --a) {
              const std::size_t place = rest % static_cast<std::size_t>(part.count[a]);
              rest /= static_cast<std::size_t>(part.count[a]);
              index += (place + static_cast<std::size_t>(part.first[a] - whole.first[a])) * stride;
              stride *= static_cast<std::size_t>(whole.count[a]);
            }
            ASSERT_EQ(result.values[i], expected.values[index]);
            for (std::size_t a = 0; a < Dim; ++a)
              ASSERT_EQ(result.gradient[a][i], expected.gradient[a][index]);
          }
        }
      }
    });
  });
}

TEST(GradientNoise, PointsInAnyOrderAreBitIdenticalToTheLattice) {
  for_each_simd_target([](std::int64_t) {
    for_each_dimension([]<int Dim>() {
      for_each_gradient_noise([](const GradientNoiseOptions& options) {
        const GradientNoise<Dim> noise(options);
        // Far from 0.
        Lattice<Dim> lattice = some_lattice(noise);
        lattice.origin = Vec<Dim>(1000.0);
        lattice.step = Vec<Dim>(0x1p-7);
        const Evaluated<Dim> expected = evaluate_in_one_block(noise, lattice);

        // Every sample, visited in a stride that scatters them over the cells.
        const std::size_t count = lattice.size();
        std::vector<Vec<Dim>> positions;
        std::vector<std::size_t> sample(count);
        for (std::size_t i = 0; i < count; ++i) {
          sample[i] = i * 1009 % count;
          positions.push_back(sample_position(lattice, sample[i]));
        }
        Evaluated<Dim> result(count);
        noise.evaluate(Points<Dim>{positions}, result.samples());
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(result.values[i], expected.values[sample[i]]);
          for (std::size_t a = 0; a < Dim; ++a)
            ASSERT_EQ(result.gradient[a][i], expected.gradient[a][sample[i]]);
        }
      });
    });
  });
}

TEST(GradientNoise, RepeatsExactlyAfterItsPeriod) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](GradientNoiseOptions options) {
      options.period = Vec<4>(1.0, 0.9, 0.7, 0.8);
      const GradientNoise<Dim> noise(options);
      // 24 samples per period and axis.
      Lattice<Dim> lattice;
      for (int axis = 0; axis < Dim; ++axis) {
        lattice.step[axis] = options.period[axis] / 24.0;
        lattice.first[axis] = -5;
        lattice.count[axis] = Dim == 4 ? 5 : 11;
      }
      const Evaluated<Dim> expected = evaluate_in_one_block(noise, lattice);
      for (int axis = 0; axis < Dim; ++axis) {
        for (const int periods : {-3, 1, 40}) {
          Lattice<Dim> shifted = lattice;
          shifted.first[axis] += 24 * periods;
          EXPECT_EQ(evaluate_in_one_block(noise, shifted), expected) << "axis " << axis;
        }
      }
      expect_agreement(noise, lattice);
    });
  });
}

TEST(GradientNoise, PeriodStretchesTheLatticeByTheLeastThatFits) {
  GradientNoiseOptions options;
  const double unit = GradientNoise<3>(options).lattice_spacing()[0];
  options.period = Vec<4>(7.2 * unit, 7.6 * unit, 0.0, 0.0);
  const GradientNoise<3> noise(options);
  EXPECT_NEAR(noise.lattice_spacing()[0], 7.2 / 7.0 * unit, 1e-12);
  EXPECT_NEAR(noise.lattice_spacing()[1], 7.6 / 8.0 * unit, 1e-12);
  EXPECT_EQ(noise.lattice_spacing()[2], unit);
  options.support = GradientNoiseOptions::Support::half;  // the nearest even count
  EXPECT_NEAR(GradientNoise<3>(options).lattice_spacing()[0], 7.2 / 8.0 * unit, 1e-12);
}

TEST(GradientNoise, TablesRepeatAfter256StepsAndTheIntegerHashDoesNot) {
  GradientNoiseOptions options;
  for (const auto hash : {GradientNoiseOptions::Hash::xor_tables, GradientNoiseOptions::Hash::integer}) {
    options.hash = hash;
    const GradientNoise<3> noise(options);
    Lattice<3> lattice;
    lattice.step = noise.lattice_spacing() / 12.0;
    lattice.count = glm::ivec3(9);
    Lattice<3> shifted = lattice;
    shifted.first[1] += 12 * 256;
    const bool repeats = evaluate_in_one_block(noise, lattice) == evaluate_in_one_block(noise, shifted);
    EXPECT_EQ(repeats, hash == GradientNoiseOptions::Hash::xor_tables);
  }
}

TEST(GradientNoise, BandAndSpectrumAreInWorldUnits) {
  GradientNoiseOptions options;
  options.frequency = 5.0;
  options.kernel = GradientNoiseOptions::Kernel::zero_dc;
  const GradientNoise<3> noise(options);
  // The radial power peaks at the frequency asked for, and the noise's total power is 1.
  const auto radial_power = [&](double f) {
    return f * f * noise.power_spectrum(Vec<3>(0.0, 0.6 * f, 0.8 * f));
  };
  EXPECT_GT(radial_power(5.0), radial_power(4.99));
  EXPECT_GT(radial_power(5.0), radial_power(5.01));
  double total = 0.0;
  constexpr double kStep = 0.01;
  for (double f = 0.5 * kStep; f < 60.0; f += kStep)
    total += 4.0 * std::numbers::pi * radial_power(f) * kStep;
  EXPECT_NEAR(total, 1.0, 1e-6);
  EXPECT_GT(noise.band().lower, 0.5);
  EXPECT_LT(noise.band().lower, 5.0);
  EXPECT_GT(noise.band().upper, 5.0);
  EXPECT_LT(noise.band().upper, 11.0);
}

TEST(GradientNoise, OptionsOutOfRangeAreRefused) {
  const auto message = [](const GradientNoiseOptions& options) {
    return message_of<std::invalid_argument>([&] { GradientNoise<3> noise(options); });
  };
  GradientNoiseOptions options;
  options.frequency = -2.0;
  EXPECT_EQ(message(options),
            "frequency is -2; it must be between 1e-12 and 1000000000000 (cycles per world unit)");
  options.frequency = 1.0;
  options.period[1] = std::nan("");
  EXPECT_EQ(message(options), "period is nan; it must be at least 0 (world units; 0 for none)");
  options.period[1] = 2.0;
  EXPECT_EQ(message(options),
            "period is 2 along y; it must be at least 2.75952 (4 steps of the lattice), or 0 for none");
  options.period[1] = 1000.0;
  EXPECT_EQ(message(options),
            "period is 1000 along y; with hash xor-tables it must be at most 176.609 (256 steps of the "
            "lattice): use "
            "hash integer, or a lower frequency");
  options.hash = GradientNoiseOptions::Hash::integer;
  EXPECT_EQ(message(options), "nothing was thrown");
}

}  // namespace
}  // namespace solidnoise::gradient_noise_test
