#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"

namespace solidnoise::gabor_smoothness_test {
namespace {

// The kernel's polynomial at the end of the support: s radii from there, the kernel is (2 s)^k times that.
double end_of(const CompactKernel& kernel) {
  constexpr double kNear = 1e-4;
  return kernel.value(kernel.radius() * (1.0 - kNear)) / std::pow(2.0 * kNear, kernel.taper());
}

// The largest difference between the gradient and fourth-order differences of the values, along an axis.
template <int Dim>
double gradient_error(const Noise<Dim>& noise, const Vec<Dim>& origin, int axis, double step) {
  Lattice<Dim> line;
  line.origin = origin;
  line.step = Vec<Dim>(step);
  line.count[axis] = 1500;
  const Evaluated<Dim> samples = evaluate_in_one_block(noise, line);
  const auto value = [&](std::size_t i) { return static_cast<double>(samples.values[i]); };
  double worst = 0.0;
  for (std::size_t i = 2; i + 2 < samples.values.size(); ++i) {
    const double difference =
        (8.0 * (value(i + 1) - value(i - 1)) - (value(i + 2) - value(i - 2))) / (12.0 * step);
    worst = std::fmax(worst, std::abs(difference - samples.gradient[static_cast<std::size_t>(axis)][i]));
  }
  return worst;
}

TEST(GaborSmoothness, GradientIsTheDerivativeAsFarAsAMillionUnitsFromTheOrigin) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([&](const auto& noise) {
      // Whole steps of 2^-20 of a cell, to which positions are rounded.
      const double cell = noise.impulses().axes()[0].size();
      const double step = 0x1p-10 * cell * std::ceil(2.0 * support_of(noise) / cell);
      // Values have rounding errors of up to 2.4e-6 (isotropic in 1D), of which the differences make 1.5
      // times that over the step of 4.5e-3: 8e-4. A kernel whose curvature jumped where it ends would be off
      // by up to 0.05, a seam of 1 % of a kernel by 2, positions in single precision by more than that.
      const double bound = 2e-3;
      for (const double far : {0.0, 1e6, -1e6}) {
        for (int axis = 0; axis < Dim; ++axis) {
          EXPECT_LT(gradient_error<Dim>(noise, Vec<Dim>(far + 0.123), axis, step), bound)
              << far << ", axis " << axis;
        }
      }
    });
  });
}

// The position of an impulse that is alone within two cells on all sides, of a noise of few impulses.
template <int Dim, template <int> class Noise>
Vec<Dim> lonely_impulse(const Noise<Dim>& noise) {
  Vec<Dim> middle(0.5 * support_of(noise));
  while (true) {
    const auto near = impulses_near(noise, middle, 3);
    if (near.size() == 1) {
      Vec<Dim> position;
      bool central = true;
      for (int axis = 0; axis < Dim; ++axis) {
        central = central && std::abs(near[0].position[axis]) < 0.5 * support_of(noise);
        position[axis] = middle[axis] + near[0].position[axis];
      }
      if (central) return position;
    }
    middle[0] += support_of(noise);
  }
}

template <int Dim, template <int> class Noise>
Evaluated<Dim> at(const Noise<Dim>& noise, const Vec<Dim>& position) {
  Lattice<Dim> lattice;
  lattice.origin = position;
  return evaluate_in_one_block<Dim>(noise, lattice);
}

// With a single impulse, whatever happens at the end of its support is seen alone.
template <int Dim, template <int> class Noise>
void expect_no_seam(const Noise<Dim>& noise) {
  const CompactKernel& kernel = profile(noise);
  const Vec<Dim> impulse = lonely_impulse(noise);
  const double end = end_of(kernel);
  const double turn =
      2.0 * std::numbers::pi;  // the wave's derivative, where there is one; its frequency is 1
  for (int axis = 0; axis < Dim; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto near_end = [&](double shares) {
        Vec<Dim> position = impulse;
        position[axis] += side * shares * kernel.radius();
        return at<Dim>(noise, position);
      };
      for (const double s : {0.01, 0.001}) {
        // The next terms of the kernel near its end are less than 8 s degree^2 of the first.
        const double slack = 1.0 + 8.0 * s * kernel.degree() * kernel.degree();
        const double height = std::pow(2.0 * s, kernel.taper()) * std::abs(end) * noise.amplitude() * slack;
        const double value = height + 1e-6;
        const double slope = kernel.taper() * height / (s * kernel.radius()) + turn * value + 1e-5;
        const Evaluated<Dim> inside = near_end(1.0 - s);
        EXPECT_LT(std::abs(inside.values[0]), value);
        for (const auto& gradient : inside.gradient) EXPECT_LT(std::abs(gradient[0]), slope);
      }
      const Evaluated<Dim> outside = near_end(1.0 + 2e-6);
      EXPECT_EQ(outside.values[0], 0.0f);
      for (const auto& gradient : outside.gradient) EXPECT_EQ(gradient[0], 0.0f);
    }
  }
  // A kernel that was cut off would be higher than this bound at s = 0.001 by far.
  EXPECT_NE(at<Dim>(noise, impulse).values[0], 0.0f);
}

TEST(GaborSmoothness, ValueAndGradientVanishAtTheEndOfAnImpulsesSupport) {
  for_each_dimension([]<int Dim>() {
    for (const double error : {0.02, 0.3}) {
      GaborNoiseOptions isotropic;
      isotropic.frequency = 1.0;
      isotropic.error = error;
      isotropic.impulses = 2e-3;
      isotropic.impulses_process = ImpulseSpread::poisson;
      const GaborNoise<Dim> noise(isotropic);
      expect_no_seam<Dim>(noise);

      OrientedGaborNoiseOptions oriented;
      oriented.frequency = 1.0;
      oriented.error = error;
      oriented.impulses = 2e-3;
      oriented.impulses_process = ImpulseSpread::poisson;
      const OrientedGaborNoise<Dim> waves(oriented);
      expect_no_seam<Dim>(waves);
    }
  });
}

}  // namespace
}  // namespace solidnoise::gabor_smoothness_test
