#include "solidnoise/noise/evolution.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/tile_spectrum.h"

namespace solidnoise::evolution_test {
namespace {

constexpr double kPi = std::numbers::pi;

// The same noise with another evolution.
template <typename Noise>
Noise evolving(const Noise& noise, const Evolution& evolution) {
  auto options = noise.options();
  options.evolution = evolution;
  return Noise(options);
}

// Slow, middling and fast; without and with a loop.
const Evolution kEvolutions[] = {
    {.rate = 0.4}, {.rate = 0.01, .loop = 2.0}, {.rate = 0.4, .loop = 2.0}, {.rate = 3.0, .loop = 0.9}};

template <typename Check>
void for_two_and_three_dimensions(const Check& check) {
  check.template operator()<2>();
  check.template operator()<3>();
}

TEST(Evolution, CorrelationIsTheMeanOverTheTurnsOfImpulses) {
  constexpr int kImpulses = 200000;
  for (Evolution evolution : kEvolutions) {
    for (const double lag : {0.07, 0.3, 0.45, 1.0, 1.7, -0.3}) {
      SCOPED_TRACE(testing::Message()
                   << "rate " << evolution.rate << ", loop " << evolution.loop << ", lag " << lag);
      evolution.time = lag;
      const ImpulseTurns turns(evolution);
      std::vector<double> values;
      for (std::uint64_t i = 0; i < kImpulses; ++i) values.push_back(turns.at(mix_bits(i)));
      const Estimate mean = estimate_mean(values, [](double turn) { return std::cos(2.0 * kPi * turn); });
      // The cosine's variance is at most 1. Where all turn once in a loop there is none, but for the rounding
      // of times to 2^-30 of the loop.
      const double sigma = evolution.rate < 0.1 ? 1e-8 : 1.0 / std::sqrt(kImpulses);
      EXPECT_NEAR(mean.mean, evolution_correlation(evolution, lag), 4.0 * sigma);
    }
  }
}

TEST(Evolution, CorrelationIsOneAtOnceAndAfterALoopAndAHalfAtTheHalfLife) {
  EXPECT_EQ(evolution_correlation({}, 5.0), 1.0);
  EXPECT_TRUE(std::isinf(evolution_half_life({})));
  for (const Evolution& evolution : kEvolutions) {
    EXPECT_NEAR(evolution_correlation(evolution, 0.0), 1.0, 1e-12);
    EXPECT_NEAR(evolution_correlation(evolution, evolution_half_life(evolution)), 0.5, 1e-12);
    if (evolution.loop == 0.0) continue;
    for (const double loops : {-1.0, 1.0, 3.0}) {
      EXPECT_NEAR(evolution_correlation(evolution, loops * evolution.loop), 1.0, 1e-12);
    }
  }
}

TEST(Evolution, FramesAreCorrelatedByTheClosedForm) {
  for_two_and_three_dimensions([]<int Dim>() {
    const auto check = [](const auto& noise) {
      const Lattice<Dim> lattice = independent_lattice<Dim>(support_of(noise));
      for (Evolution evolution : {kEvolutions[0], kEvolutions[2]}) {
        evolution.time = 17.3;
        const auto first = values_of<Dim>(evolving(noise, evolution), lattice);
        evolution.time += 0.3;
        const auto second = values_of<Dim>(evolving(noise, evolution), lattice);
        std::vector<double> products;
        for (std::size_t i = 0; i < first.size(); ++i) {
          products.push_back(static_cast<double>(first[i]) * static_cast<double>(second[i]));
        }
        expect_within_4_sigma(estimate_mean(products, [](double x) { return x; }),
                              evolution_correlation(evolution, 0.3));
      }
    };
    for_each_gabor_noise<Dim>(check);
  });
}

TEST(Evolution, EachFrameHasTheMomentsOfTheClosedForms) {
  for_two_and_three_dimensions([]<int Dim>() {
    const auto check = [](const auto& noise) {
      for (Evolution evolution : {kEvolutions[0], kEvolutions[2]}) {
        evolution.time = 0.61;
        const auto frame = evolving(noise, evolution);
        const auto values = values_of<Dim>(frame, independent_lattice<Dim>(support_of(frame)));
        expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
        expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), frame.variance());
        expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                              frame.excess_kurtosis() + 3.0);
      }
    };
    for_each_gabor_noise<Dim>(check);
  });
}

TEST(Evolution, TurningWeightsHaveThreeHalvesOfTheExcessKurtosis) {
  for (const ImpulseWeights weights : {ImpulseWeights::signs, ImpulseWeights::uniform}) {
    const GaborNoise<3> still(
        GaborNoiseOptions{.impulses = 20.0, .impulses_process = ImpulseSpread::poisson, .weights = weights});
    const auto moving = evolving(still, {.rate = 1.0});
    EXPECT_NEAR(moving.excess_kurtosis(), 1.5 * still.excess_kurtosis(), 1e-12);
    const auto values = values_of<3>(moving, independent_lattice<3>(moving.radius()));
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                          3.0 + moving.excess_kurtosis());
  }
  // Phases are random anyway.
  const OrientedGaborNoise<3> still(OrientedGaborNoiseOptions{.impulses = 20.0});
  EXPECT_EQ(evolving(still, {.rate = 1.0}).excess_kurtosis(), still.excess_kurtosis());
}

// A frame of few impulses per tile, of many seeds: see TileSpectrum.
template <typename Noise, typename Options>
void expect_spectrum_of_frames(Options options, double time) {
  constexpr double kPeriod = 8.0;
  constexpr int kTiles = 40;
  options.frequency = 1.0;
  options.impulses = 150.0;
  options.period = Vec<4>(kPeriod);
  options.error = 0.002;  // the closed form is that of the kernel before it was made compact
  options.evolution = {.rate = 0.7, .time = time, .loop = 3.0};
  const Noise first(options);
  const auto in_band = [](const WaveNumber<2>& k) {
    const double f = glm::length(Vec<2>(k)) / kPeriod;
    return f < 0.45 || f > 1.7 ? -1 : static_cast<int>((f - 0.45) / 0.25);
  };
  TileSpectrum<2> spectrum(64, kPeriod);
  spectrum.set_bins(5, in_band, [&](const Vec<2>& f) { return first.power_spectrum(f); });
  for (int seed = 0; seed < kTiles; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    spectrum.add(Noise(options));
  }
  // An impulse's power varies by its weight, whose mean fourth power is 3/2, or, of a wave, hardly.
  spectrum.expect_closed_form(first.impulse_density() * kPeriod * kPeriod, 2.0, 0.02);
}

TEST(Evolution, EachFrameHasTheSpectrumOfTheNoise) {
  for (const double time : {0.0, 1.3}) {
    expect_spectrum_of_frames<GaborNoise<2>>(GaborNoiseOptions{}, time);
    expect_spectrum_of_frames<OrientedGaborNoise<2>>(OrientedGaborNoiseOptions{}, time);
  }
}

// Frames at n / fps, and those any number of loops away, computed as a user would: in double precision.
template <int Dim, typename MakeFrame>
void expect_loop(const MakeFrame& frame_at, double loop, double support) {
  const Lattice<Dim> lattice = some_lattice<Dim>(support);
  const auto values_at = [&](double time) { return evaluate_in_one_block<Dim>(*frame_at(time), lattice); };
  for (const double fps : {24.0, 25.0, 30000.0 / 1001.0}) {
    for (const int n : {0, 1, 7, 19}) {
      const double time = n / fps;
      const Evaluated<Dim> expected = values_at(time);
      for (const int loops : {-3, 1, 100}) {
        EXPECT_EQ(values_at(time + loops * loop), expected) << n << " / " << fps << ", " << loops << " loops";
      }
      EXPECT_NE(values_at(time + 0.37 * loop), expected);
    }
  }
}

// Loops of whole frames and of any other length.
const double kLoops[] = {2.0, 53.0 / 24.0, 1.0 / 3.0, 1.7};

TEST(Evolution, LoopsToTheLastBit) {
  for (const double loop : kLoops) {
    const auto check = [loop](const auto& noise) {
      const auto frame_at = [&](double time) {
        return std::make_unique<std::decay_t<decltype(noise)>>(
            evolving(noise, {.rate = 0.8, .time = time, .loop = loop}));
      };
      expect_loop<2>(frame_at, loop, support_of(noise));
    };
    for_each_gabor_noise<2>(check);
  }
}

TEST(Evolution, OctavesLoopTogether) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0, .evolution = {.rate = 0.8, .loop = 2.0}};
  recipe.fractal = {.octaves = 3, .lacunarity = 1.9};
  expect_loop<2>([&](double time) { return make_noise<2>(at_time(recipe, time)); }, 2.0, 1.0);
}

TEST(Evolution, OctavesTurnFasterByThePowerTwoThirdsOfTheirFrequency) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.evolution = {.rate = 0.5, .time = 3.0, .loop = 2.0}};
  recipe.fractal = {.octaves = 4, .lacunarity = 8.0};
  const Evolution octave = *evolution_of(octave_of(recipe, 2));
  EXPECT_NEAR(octave.rate, 0.5 * 16.0, 1e-12);
  EXPECT_EQ(octave.time, 3.0);
  EXPECT_EQ(octave.loop, 2.0);
}

// Half way through a loop in which every impulse turns once, all weights and waves have the opposite sign.
TEST(Evolution, EverythingMovesHoweverSlowly) {
  const auto check = [](const auto& noise) {
    const Lattice<3> lattice = some_lattice<3>(support_of(noise));
    const auto start = values_of<3>(evolving(noise, {.rate = 1e-6, .loop = 5.0}), lattice);
    const auto half = values_of<3>(evolving(noise, {.rate = 1e-6, .time = 2.5, .loop = 5.0}), lattice);
    for (std::size_t i = 0; i < start.size(); ++i) ASSERT_NEAR(half[i], -start[i], 1e-5);  // single precision
  };
  for_each_gabor_noise<3>(check);
}

TEST(Evolution, WithoutARateTimeHasNoEffect) {
  const auto check = [](const auto& noise) {
    const Lattice<3> lattice = some_lattice<3>(support_of(noise));
    EXPECT_EQ(values_of<3>(evolving(noise, {.time = 3.7}), lattice), values_of<3>(noise, lattice));
  };
  for_each_gabor_noise<3>(check);
  EXPECT_EQ(evolution_of(NoiseRecipe{.noise = GradientNoiseOptions{}, .fractal = {}}), nullptr);
}

TEST(Evolution, BadOptionsAreRefused) {
  const auto refusal = [](const Evolution& evolution) {
    return message_of<std::invalid_argument>([&] { evolution.validate(); });
  };
  EXPECT_EQ(refusal({.rate = -1.0}),
            "evolve is -1; it must be between 0 and 1000000 (turns per unit of time)");
  EXPECT_EQ(refusal({.rate = 1.0, .time = NAN}), "time is nan; it must be a finite number");
  EXPECT_EQ(refusal({.rate = 1.0, .loop = -2.0}),
            "loop is -2; it must be at least 0 (units of time; 0 for none)");
  EXPECT_EQ(refusal({.loop = 2.0}), "loop is 2; it must be 0, for without evolve nothing moves");
  EXPECT_EQ(refusal({.rate = 1e3, .loop = 1e4}),
            "loop is 10000; it must be at most 1000 where evolve is 1000");
  EXPECT_EQ(message_of<std::invalid_argument>(
                [] { GaborNoise<2>{GaborNoiseOptions{.evolution = {.rate = INFINITY}}}; }),
            "evolve is inf; it must be between 0 and 1000000 (turns per unit of time)");
}

}  // namespace
}  // namespace solidnoise::evolution_test
