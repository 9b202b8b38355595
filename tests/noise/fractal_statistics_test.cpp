#include <algorithm>
#include <cmath>

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
      EXPECT_NEAR(octave->excess_kurtosis(), 0.15, 0.02);
      EXPECT_LT(octave->waves().impulses, 0.8 * alone->waves().impulses);
      const double support = octave->waves().radius;
      const auto values = values_of<Dim>(*octave, independent_lattice<Dim>(support));
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                            3.0 + octave->excess_kurtosis());
    });
  });
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
