#include "solidnoise/noise/kernel/impulse_statistics.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"
#include "support/golden.h"
#include "support/relative_error.h"

namespace solidnoise::impulse_statistics_test {
namespace {

using nlohmann::json;

constexpr double kExact =
    1e-9;  // golden values are exact; closed forms in double precision lose a few digits

template <int Dim>
Vec<Dim> along_first_axis(double f) {
  Vec<Dim> w(0.0);
  w[0] = f;
  return w;
}

TEST(ImpulseStatistics, NoisesAgreeWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const IsotropicGaborKernel<Dim> isotropic(expected["K"], expected["F0"], expected["a"]);
    const Vec<Dim> w = along_first_axis<Dim>(expected["F0"]);
    const RandomPhaseGaborKernel<Dim> random_phase(expected["K"], expected["a"], w);
    const json& noise = expected["noise"];

    const double density = impulse_density(Dim, noise["N"], noise["radius"]);
    EXPECT_TRUE(within(kExact, density, noise["lam"]));
    EXPECT_TRUE(within(kExact, impulses_in_ball(Dim, density, noise["radius"]), noise["N"]));

    const WeightMoments uniform = weight_moments(ImpulseWeights::uniform);
    EXPECT_TRUE(
        within(kExact, noise_variance(density, isotropic.energy(), uniform), noise["var_iso_uniformW"]));
    const double squared_spectrum = std::pow(isotropic.spectrum(expected["F0"]), 2);
    EXPECT_TRUE(
        within(kExact, noise_variance(density, squared_spectrum, uniform), noise["psd_iso_uniformW_at_F0"]));
    // Golden values of the random phase are for a noise divided by the square root of the density.
    EXPECT_TRUE(within(kExact, noise_variance(density, random_phase.energy()) / density,
                       noise["var_aniso_randomphase_norm_by_sqrt_lambda"]));
    EXPECT_TRUE(within(kExact, noise_variance(density, random_phase.power_spectrum(w)) / density,
                       noise["psd_aniso_rp_at_omega"]));

    const json& kurtosis = expected["excess_kurtosis"];
    const KernelMoments isotropic_moments{isotropic.energy(), isotropic.fourth_moment()};
    const KernelMoments random_moments{random_phase.energy(), random_phase.fourth_moment()};
    EXPECT_TRUE(
        within(kExact, noise_excess_kurtosis(density, isotropic_moments, uniform), kurtosis["iso_uniformW"]));
    EXPECT_TRUE(within(kExact, noise_excess_kurtosis(density, isotropic_moments), kurtosis["iso_signW"]));
    EXPECT_TRUE(
        within(kExact, noise_excess_kurtosis(density, random_moments), kurtosis["aniso_random_phase"]));
  });
}

TEST(ImpulseStatistics, DensityForExcessKurtosisInvertsIt) {
  const KernelMoments moments{0.3, 0.07};
  const WeightMoments uniform = weight_moments(ImpulseWeights::uniform);
  const double density = density_for_excess_kurtosis(0.5, moments, uniform);
  EXPECT_DOUBLE_EQ(noise_excess_kurtosis(density, moments, uniform), 0.5);
}

TEST(ImpulseStatistics, WeightMomentsAreThoseOfTheLaws) {
  // Midpoint sums over [-1, 1], exact to 1e-6 with 1000 points.
  double second = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double w = -1.0 + (i + 0.5) / 500.0;
    second += w * w / 1000.0;
    fourth += w * w * w * w / 1000.0;
  }
  EXPECT_NEAR(weight_moments(ImpulseWeights::uniform).second, second, 1e-5);
  EXPECT_NEAR(weight_moments(ImpulseWeights::uniform).fourth, fourth, 1e-5);
  EXPECT_EQ(weight_moments(ImpulseWeights::signs).second, 1.0);
  EXPECT_EQ(weight_moments(ImpulseWeights::signs).fourth, 1.0);
}

// A plain simulation of Campbell's theorem: noise at the origin, from impulses uniform in an interval that is
// much longer than the kernel, as many as the density gives on average, by a Poisson law.
TEST(ImpulseStatistics, MomentsAgreeWithASimulation) {
  const auto kernel = IsotropicGaborKernel<1>::with_unit_peak(1.0, gaussian_parameter(1.0, 1.0));
  constexpr double kDensity = 1.0;
  constexpr double kHalfLength = 3.0;
  constexpr int kTrials = 200000;
  RandomStream stream(derive_seed(1, 1));
  double second = 0.0;
  double fourth = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    double value = 0.0;
    // Distances between consecutive points of a Poisson process are exponential.
    double x = -kHalfLength - std::log(1.0 - stream.next_unit()) / kDensity;
    while (x < kHalfLength) {
      const double weight = stream.next_unit() < 0.5 ? -1.0 : 1.0;
      value += weight * kernel.value(x);
      x -= std::log(1.0 - stream.next_unit()) / kDensity;
    }
    second += value * value / kTrials;
    fourth += std::pow(value, 4) / kTrials;
  }
  const double variance = noise_variance(kDensity, kernel.energy());
  const double kurtosis = noise_excess_kurtosis(kDensity, {kernel.energy(), kernel.fourth_moment()});
  // Standard error of the second moment: sqrt((2 + kurtosis) / trials). That of the fourth: sqrt(96 / trials)
  // for a Gaussian, at most three times as much for the excess kurtosis of about 1 here. Four of each.
  EXPECT_NEAR(second / variance, 1.0, 4.0 * std::sqrt((2.0 + kurtosis) / kTrials));
  EXPECT_NEAR(fourth / (variance * variance) - 3.0, kurtosis, 12.0 * std::sqrt(96.0 / kTrials));
  EXPECT_GT(kurtosis, 1.0);  // far enough from 0 for this to be a test
}

}  // namespace
}  // namespace solidnoise::impulse_statistics_test
