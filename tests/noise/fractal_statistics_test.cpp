#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"

namespace solidnoise::fractal_statistics_test {
namespace {

constexpr double kGains[] = {0.05, 0.3, 0.5, 0.55, 0.7, 0.85, 1.0, 2.0};

// Calls check with both kinds of Gabor noise, of default numbers of impulses.
template <typename Check>
void for_both_kinds(const Check& check, double bandwidth = 1.0) {
  {
    SCOPED_TRACE("isotropic");
    check(GaborNoiseOptions{.bandwidth = bandwidth, .seed = 5});
  }
  SCOPED_TRACE("oriented");
  check(OrientedGaborNoiseOptions{.bandwidth = bandwidth, .seed = 5});
}

TEST(FractalStatistics, KurtosisOfTheSumIsWithinItsTolerance) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.5, 1.0, 2.0}) {
      for_both_kinds(
          [&](const auto& options) {
            const double alone = make_noise<Dim>(NoiseRecipe{options, {}})->excess_kurtosis();
            for (const double gain : kGains) {
              for (const int octaves : {2, 4}) {
                const FractalOptions fractal{.octaves = octaves, .gain = gain};
                const double kurtosis = make_noise<Dim>(NoiseRecipe{options, fractal})->excess_kurtosis();
                // Compact kernels are a little narrower than those that impulses are chosen for.
                EXPECT_LT(std::abs(kurtosis), std::max(0.021, std::abs(alone)))
                    << bandwidth << " octaves wide, " << octaves << " octaves, gain " << gain;
              }
            }
          },
          bandwidth);
    }
  });
}

TEST(FractalStatistics, LaterOctavesHaveTheMomentsThatTheyState) {
  for_each_dimension([]<int Dim>() {
    for_both_kinds([](const auto& options) {
      const auto alone = make_noise<Dim>(NoiseRecipe{options, {}});
      const auto octave = make_noise<Dim>(octave_of(NoiseRecipe{options, {.octaves = 4}}, 2));
      EXPECT_LT(std::abs(octave->excess_kurtosis()), 0.17);
      EXPECT_LT(octave->waves().impulses, 0.8 * alone->waves().impulses);
      std::vector<float> values;
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        auto other = octave_of(NoiseRecipe{options, {.octaves = 4}}, 2);
        std::visit([&](auto& of_octave) { of_octave.seed = seed; }, other.noise);
        const auto noise = make_noise<Dim>(other);
        const auto more = values_of<Dim>(*noise, independent_lattice<Dim>(noise->waves().radius));
        values.insert(values.end(), more.begin(), more.end());
      }
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
      const Estimate fourth = estimate_mean(values, [](double x) { return x * x * x * x; });
      EXPECT_LT(fourth.error, 0.035);  // else the test says little
      expect_within_4_sigma(fourth, 3.0 + octave->excess_kurtosis());
    });
  });
}

TEST(FractalStatistics, KurtosesOfOctavesAddUpToThatOfTheSum) {
  for (const double gain : kGains) {
    for (int octaves = 2; octaves <= 16; ++octaves) {
      const FractalOptions fractal{.octaves = octaves, .gain = gain};
      double sum = 0.0;
      for (int k = 0; k < octaves; ++k) {
        const double share = fractal.amplitude_ratio(2 * k) / fractal.power_of_ratios();
        sum += share * share * fractal.kurtosis_of_octave(k, 0.02);
      }
      EXPECT_LE(sum, 0.02) << octaves << " octaves, gain " << gain;
      EXPECT_EQ(fractal.kurtosis_of_octave(1, 0.02) > 0.07, gain <= 0.85);
    }
  }
}

// So that it may change from frame to frame.
TEST(FractalStatistics, ImpulsesOfOctavesStayWhileTheGainChanges) {
  for_both_kinds([](const auto& options) {
    for (int k = 0; k < 3; ++k) {
      const NoiseRecipe quick = octave_of({options, {.octaves = 3, .gain = 0.2}}, k);
      NoiseRecipe slow = octave_of({options, {.octaves = 8, .gain = 0.55}}, k);
      slow.fractal.gain = 0.2;
      EXPECT_TRUE(quick == slow);
    }
  });
}

}  // namespace
}  // namespace solidnoise::fractal_statistics_test
