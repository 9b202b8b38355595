#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "papers/strata_sample.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"

// The numbers of docs/papers/impulses-in-strata.md, by smaller runs of the code that makes the page. Seeds
// are fixed.
namespace solidnoise::papers {
namespace {

MakeNoise<2> maker(ImpulseSpread process) {
  const OrientedGaborNoiseOptions options{.frequency = 1.0};
  const double impulses = OrientedGaborNoise<2>(options).impulses_per_kernel();
  return [process, impulses](std::uint64_t seed) {
    return std::make_unique<const OrientedGaborNoise<2>>(OrientedGaborNoiseOptions{
        .frequency = 1.0, .impulses = impulses, .impulses_process = process, .seed = seed});
  };
}

double radius() {
  return OrientedGaborNoise<2>({.frequency = 1.0}).radius();
}

TEST(ImpulsesInStrata, EstimatesHaveTheErrorOfTheirMean) {
  const Estimate found = estimate({1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(found.value, 3.0);
  EXPECT_DOUBLE_EQ(found.error, std::sqrt(14.0 / 12.0));
}

// Of 40 seeds: five standard errors, which are some 0.002 of the variance and 0.02 of the kurtosis.
TEST(ImpulsesInStrata, HaveTheMomentsOfTheClosedForm) {
  const Ensemble strata = measure_ensemble<2>(maker(ImpulseSpread::strata), 1.1 * radius(), 40);
  EXPECT_NEAR(strata.variance.value, 1.0, 5.0 * strata.variance.error);
  EXPECT_NEAR(strata.excess_kurtosis.value, 0.0, 5.0 * strata.excess_kurtosis.error + 0.01);
  const Ensemble poisson = measure_ensemble<2>(maker(ImpulseSpread::poisson), 1.1 * radius(), 40);
  EXPECT_NEAR(poisson.variance.value, 1.0, 5.0 * poisson.variance.error);
  EXPECT_NEAR(poisson.excess_kurtosis.value, maker(ImpulseSpread::poisson)(0)->excess_kurtosis(),
              5.0 * poisson.excess_kurtosis.error);
  EXPECT_GT(poisson.beyond_4.value, 3.0 * strata.beyond_4.value);
}

// Errors are some 4 % of windows of four radii.
TEST(ImpulsesInStrata, HaveWindowsMoreAlikeThanAPoissonProcess) {
  const auto strata = measure_windows(maker(ImpulseSpread::strata), radius(), 20);
  const auto poisson = measure_windows(maker(ImpulseSpread::poisson), radius(), 20);
  ASSERT_EQ(strata.size(), 5u);
  EXPECT_EQ(strata[2].side, 4.0);
  EXPECT_LT(strata[2].spread.value, 1.15);
  EXPECT_GT(poisson[2].spread.value, 1.6);
}

}  // namespace
}  // namespace solidnoise::papers
