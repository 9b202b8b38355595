#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"

namespace solidnoise::gabor_truncation_test {
namespace {

// The root mean square of what the noise lacks, relative to the noise of unlimited kernels at the same
// impulses: both before they are scaled to unit variance.
template <int Dim, template <int> class Noise>
Estimate measured_error(const Noise<Dim>& noise, double unlimited_energy) {
  constexpr std::array kCount = {6000, 77, 18, 9};  // about 6000 samples
  Lattice<Dim> lattice = independent_lattice<Dim>(support_of(noise));
  lattice.step *= 2.0;  // twice as far apart, as here an impulse counts as far as two cells away
  lattice.count = glm::vec<Dim, int>(kCount[Dim - 1]);
  const auto values = values_of<Dim>(noise, lattice);

  using Offset = reference::Position<Dim>;
  using Impulse = reference::Impulse<Dim>;
  const auto kernel = kernel_reference(noise);
  std::vector<double> squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto impulses = impulses_near(noise, sample_position(lattice, i), 2);
    const double unlimited = reference::sum_impulses<Dim>(
        impulses, Offset{},
        [&](const Offset& offset, const Impulse& impulse) { return kernel.unlimited(offset, impulse); });
    squares.push_back(std::pow(values[i] / noise.amplitude() - unlimited, 2));
  }
  const Estimate squared = estimate_mean(squares, [](double x) { return x; });
  const double power = noise.impulse_density() * unlimited_energy;
  const double error = std::sqrt(squared.mean / power);
  return {error, 0.5 * squared.error / power / error};
}

TEST(GaborTruncation, MeasuredErrorIsTheRequestedOne) {
  for_each_dimension([]<int Dim>() {
    for (const double error : {0.02, 0.1}) {
      SCOPED_TRACE(testing::Message() << "error " << error);
      // Within 10 %, of which the estimate's standard error is at most a fourth: 6e-5 of false alarms. What
      // an impulse more than two cells away would add is below 1e-3 of the error.
      const auto expect_requested = [&](const Estimate& measured) {
        EXPECT_LT(measured.error, 0.025 * error);
        EXPECT_NEAR(measured.mean, error, 0.1 * error);
      };
      GaborNoiseOptions isotropic;
      isotropic.error = error;
      isotropic.impulses = 10.0;
      isotropic.seed = 77;
      const GaborNoise<Dim> noise(isotropic);
      expect_requested(measured_error(noise, noise.kernel().energy()));

      OrientedGaborNoiseOptions oriented;
      oriented.error = error;
      oriented.impulses = 10.0;
      oriented.seed = 78;
      const OrientedGaborNoise<Dim> waves(oriented);
      expect_requested(measured_error(waves, waves.kernel().energy()));
    }
  });
}

TEST(GaborTruncation, MoreErrorMeansASmallerRadius) {
  for_each_dimension([]<int Dim>() {
    double isotropic = HUGE_VAL;
    double oriented = HUGE_VAL;
    for (const double error : {0.001, 0.02, 0.1, 0.4}) {
      const double radius = GaborNoise<Dim>(GaborNoiseOptions{.error = error}).radius();
      const OrientedGaborNoise<Dim> waves(OrientedGaborNoiseOptions{.error = error});
      EXPECT_LT(radius, isotropic);
      EXPECT_LT(support_of(waves), oriented);
      isotropic = radius;
      oriented = support_of(waves);
    }
  });
}

}  // namespace
}  // namespace solidnoise::gabor_truncation_test
