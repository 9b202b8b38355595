#include "solidnoise/noise/kernel/kernel_family.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "support/message_of.h"

namespace solidnoise::kernel_family_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Integral over the unit ball of a radial function.
template <typename Function>
double over_ball(int n, const Function& function) {
  return unit_sphere_area(n) *
         integrate([&](double r) { return function(r) * std::pow(r, n - 1); }, 0.0, 1.0, 60);
}

TEST(KernelFamily, IsTheCheapestCompactKernelAtTheReference) {
  const double a = gaussian_parameter(1.0, 1.3);
  const CompactKernel expected = compact_kernel(IsotropicGaborKernel<3>::with_unit_peak(1.0, a), 0.02);
  const KernelFamily family(3, GaborWaves::isotropic, 1.3, 0.02);
  const KernelFamily::Member member = family.at(1.3);
  EXPECT_NEAR(member.cycles, expected.radius(), 1e-12);
  const CompactKernel kernel = family.compact(member);
  for (double r = 0.0; r < 1.0; r += 0.1)
    EXPECT_NEAR(kernel.value(r), expected.value(r * expected.radius()), 1e-12);
  EXPECT_NEAR(member.energy * std::pow(expected.radius(), 3), expected.energy(), 1e-12);
}

template <int Dim>
void expect_near_the_gabor_kernel(const KernelFamily& family, double bandwidth, double error) {
  const KernelFamily::Member member = family.at(bandwidth);
  const CompactKernel compact = family.compact(member);
  const auto kernel = IsotropicGaborKernel<Dim>::with_unit_peak(1.0, gaussian_parameter(1.0, bandwidth));
  const double inside = over_ball(
      Dim, [&](double r) { return std::pow(compact.value(r) - kernel.value(r * member.cycles), 2); });
  const double tail = std::pow(kernel.relative_error(member.cycles), 2);
  const double measured = std::sqrt(inside * std::pow(member.cycles, Dim) / kernel.energy() + tail);
  EXPECT_LT(measured, 3.0 * error) << Dim << "D, " << bandwidth << " octaves";
}

TEST(KernelFamily, StaysWithinThreeTimesTheErrorAtAllBandwidths) {
  for (const double error : {0.02, 0.1}) {
    for (const double reference : {0.5, 1.0, 2.0}) {
      const KernelFamily of2(2, GaborWaves::isotropic, reference, error);
      const KernelFamily of3(3, GaborWaves::isotropic, reference, error);
      const KernelFamily of4(4, GaborWaves::isotropic, reference, error);
      for (double bandwidth = 0.1; bandwidth < 4.0; bandwidth *= 1.31) {
        expect_near_the_gabor_kernel<2>(of2, bandwidth, error);
        expect_near_the_gabor_kernel<3>(of3, bandwidth, error);
        expect_near_the_gabor_kernel<4>(of4, bandwidth, error);
      }
    }
  }
}

// The integral of its square that a member of the family has.
double energy_of(const KernelFamily& family, int n, const KernelFamily::Member& member) {
  const CompactKernel kernel = family.compact(member);
  return over_ball(n, [&](double r) {
    const double wave = family.waves() == GaborWaves::isotropic
                            ? 1.0
                            : 0.5 + 0.5 * mean_cosine(n, 4.0 * kPi * member.cycles * r);
    return std::pow(kernel.value(r), 2) * wave;
  });
}

TEST(KernelFamily, EnergyIsThatOfTheInterpolatedKernel) {
  for (int n = 2; n <= 4; ++n) {
    for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
      const KernelFamily family(n, waves, 1.0, 0.02);
      for (double bandwidth = 0.1; bandwidth <= 4.0; bandwidth *= 1.137) {
        const KernelFamily::Member member = family.at(bandwidth);
        // Isotropic: both are exact. Oriented: the third difference of a smooth function over steps of 1/16
        // octave.
        const double tolerance = waves == GaborWaves::isotropic ? 1e-12 : 1e-5;
        EXPECT_NEAR(member.energy / energy_of(family, n, member), 1.0, tolerance)
            << n << "D, " << bandwidth << " octaves";
      }
    }
  }
}

TEST(KernelFamily, EnergyIsThatOfLongerWavesToo) {
  for (int n = 2; n <= 4; ++n) {
    const KernelFamily family(n, GaborWaves::oriented, 1.0, 0.02);
    for (const double bandwidth : {0.3, 1.0, 2.2}) {
      for (double coherence = 0.0; coherence <= 1.0; coherence += 0.03125) {
        const KernelFamily::Member member = family.at(bandwidth, coherence);
        EXPECT_DOUBLE_EQ(member.cycles, coherence * family.cycles(bandwidth));
        EXPECT_NEAR(member.energy / energy_of(family, n, member), 1.0, 2e-5)
            << n << "D, " << bandwidth << " octaves, coherence " << coherence;
      }
    }
  }
}

TEST(KernelFamily, IsContinuousInTheBandwidth) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    const KernelFamily family(2, waves, 1.0, 0.02);
    for (int step = -16; step <= 260; step += 6) {
      // On both sides of a tabulated kernel, where other tables come into play.
      const double a =
          gaussian_parameter(1.0, 1.0) / (1.0 + step * KernelFamily::kStep / family.at(1.0).cycles);
      const double bandwidth = bandwidth_in_octaves(1.0, a);
      if (bandwidth < 0.101 || bandwidth > 3.99) continue;
      const auto below = family.at(bandwidth * (1.0 - 1e-9));
      const auto above = family.at(bandwidth * (1.0 + 1e-9));
      EXPECT_NEAR(below.cycles, above.cycles, 1e-6);
      EXPECT_NEAR(below.energy, above.energy, 1e-6);
      for (double r = 0.0; r < 1.0; r += 0.05) {
        EXPECT_NEAR(family.compact(below).value(r), family.compact(above).value(r), 1e-6);
      }
    }
  }
}

TEST(KernelFamily, OrientedEnvelopeIsTheGaussianWithinTheError) {
  for (int n = 2; n <= 4; ++n) {
    const KernelFamily family(n, GaborWaves::oriented, 1.0, 0.02);
    const KernelFamily::Member member = family.at(1.0);
    const CompactKernel envelope = family.compact(member);
    const double scaled_a = gaussian_parameter(1.0, 1.0) * member.cycles;
    const auto gaussian = [&](double r) { return std::exp(-kPi * std::pow(scaled_a * r, 2)); };
    const double inside =
        over_ball(n, [&](double r) { return std::pow(envelope.value(r) - gaussian(r), 2); });
    const double whole = std::pow(std::numbers::sqrt2 * scaled_a, -n);
    const double tail = whole * regularized_gamma_q(0.5 * n, 2.0 * kPi * scaled_a * scaled_a);
    EXPECT_NEAR(std::sqrt((inside + tail) / whole), 0.02, 1e-6);
  }
}

TEST(KernelFamily, RefusesBandwidthsOutOfRange) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { KernelFamily(3, GaborWaves::isotropic, 5.0, 0.02); }),
            "bandwidth is 5; it must be between 0.1 and 4 (octaves)");
}

}  // namespace
}  // namespace solidnoise::kernel_family_test
