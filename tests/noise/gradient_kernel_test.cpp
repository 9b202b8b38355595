#include "solidnoise/noise/gradient/gradient_kernel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "support/each_dimension.h"
#include "support/golden.h"
#include "support/relative_error.h"

namespace solidnoise::gradient_kernel_test {
namespace {

using Kernel = GradientNoiseOptions::Kernel;
using Support = GradientNoiseOptions::Support;

constexpr double kGolden = 1e-9;  // the closed forms' promise, relative

// Runs a check on every kernel and support of every dimension.
template <typename Check>
void for_each_kernel(const Check& check) {
  for_each_dimension([&]<int Dim>() {
    for (const Kernel kernel : {Kernel::kensler, Kernel::zero_dc}) {
      for (const Support support : {Support::full, Support::half}) {
        SCOPED_TRACE(testing::Message()
                     << "kernel " << static_cast<int>(kernel) << ", support " << static_cast<int>(support));
        check(GradientKernel<Dim>(kernel, support), support == Support::half ? 2.0 : 1.0);
      }
    }
  });
}

template <int Dim>
double radial_power(const GradientKernel<Dim>& kernel, double lower, double upper) {
  return unit_sphere_area(Dim) *
         integrate([&](double f) { return std::pow(f, Dim - 1) * kernel.power_spectrum(f); }, lower, upper,
                   40);
}

// Mean of a function of the position over a lattice cell: the midpoint rule, which converges fast because the
// function is periodic and smooth.
template <int Dim, typename Function>
double mean_over_cell(double cell, const Function& function) {
  const int points = cell == 1.0 ? 8 : 16;  // per axis
  Vec<Dim> x;
  double sum = 0.0;
  const int total = static_cast<int>(std::pow(points, Dim));
  for (int index = 0; index < total; ++index) {
    int rest = index;
    for (int axis = 0; axis < Dim; ++axis) {
      x[axis] = cell * (rest % points + 0.5) / points;
      rest /= points;
    }
    sum += function(x);
  }
  return sum / total;
}

// Variance of the noise at x in the cell, whose corners are the lattice points: of sums over those in reach.
template <int Dim>
double variance_at(const GradientKernel<Dim>& kernel, double cell, const Vec<Dim>& x) {
  const int points = cell == 1.0 ? 4 : 2;  // per axis
  const int total = static_cast<int>(std::pow(points, Dim));
  double sum = 0.0;
  for (int index = 0; index < total; ++index) {
    int rest = index;
    double square = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      square += std::pow(x[axis] - cell * (rest % points + 1 - points / 2), 2);
      rest /= points;
    }
    sum += square * std::pow(kernel.value(std::sqrt(square)), 2);
  }
  return sum / Dim;
}

TEST(GradientKernel, ClosedFormsAgreeWithGoldenValues) {
  const auto cases = golden("kensler.json")["kensler"];
  for_each_dimension([&]<int Dim>() {
    const auto& expected = cases[Dim - 1];
    ASSERT_EQ(expected["n"], Dim);
    for (const Kernel kind : {Kernel::kensler, Kernel::zero_dc}) {
      const auto& figures = expected[kind == Kernel::kensler ? "kensler" : "zero_dc"];
      const GradientKernel<Dim> kernel(kind);
      EXPECT_TRUE(within(kGolden, kernel.c1(), figures["c1"]));
      EXPECT_TRUE(within(kGolden, kernel.c2(), figures["c2"]));
      EXPECT_TRUE(within(kGolden, kernel.mean_variance(), figures["mean_variance"]));
      for (const auto& point : figures["psd"]) {
        EXPECT_TRUE(within(kGolden, kernel.power_spectrum(point["f"]), point["S"])) << "f = " << point["f"];
      }
      EXPECT_TRUE(within(kGolden, kernel.radial_peak(), figures["radial_power_peak_f"]));
    }
    const GradientKernel<Dim> kernel(Kernel::kensler);
    for (const auto& point : expected["variance_at"]) {
      Vec<Dim> x;
      for (int axis = 0; axis < Dim; ++axis) x[axis] = point["x"][static_cast<std::size_t>(axis)];
      // The variance is 0 at the lattice points in 1D.
      EXPECT_NEAR(variance_at(kernel, 1.0, x), point["variance"].get<double>(),
                  kGolden * kernel.mean_variance());
    }
  });
}

TEST(GradientKernel, ValueIsThePublishedPolynomialAndEndsSmoothly) {
  const GradientKernel<3> kernel(Kernel::kensler);
  for (const double x : {0.0, 0.3, 1.0, 1.5, 1.99}) {
    // The paper's first form.
    const double expected = std::pow(2.0 - x, 4) * std::pow(2.0 + x, 4) * (1.0 - x) * (1.0 + x) / 256.0;
    EXPECT_NEAR(kernel.value(x), expected, 1e-14) << x;
  }
  EXPECT_EQ(kernel.value(2.0), 0.0);
  EXPECT_EQ(kernel.value(3.0), 0.0);
}

TEST(GradientKernel, SpectrumIntegratesToTheMeanVariance) {
  // The rest past f = 8 falls as f^-10 from 1e-5 of the peak at f = 2.
  for_each_kernel([]<int Dim>(const GradientKernel<Dim>& kernel, double) {
    EXPECT_TRUE(within(1e-8, radial_power(kernel, 0.0, 8.0), kernel.mean_variance()));
  });
}

TEST(GradientKernel, MeanVarianceIsTheMeanOfTheVarianceOverTheCell) {
  // |x|^2 s^2 is a polynomial that vanishes to the 8th order at the radius, so its Fourier coefficients at
  // the rule's 8 (16 for half) points per cell are below 1e-7 of the mean.
  for_each_kernel([]<int Dim>(const GradientKernel<Dim>& kernel, double cell) {
    const double mean =
        mean_over_cell<Dim>(cell, [&](const Vec<Dim>& x) { return variance_at(kernel, cell, x); });
    EXPECT_TRUE(within(1e-6, mean, kernel.mean_variance()));
  });
}

TEST(GradientKernel, ZeroDcKernelHasNoPowerAtLowFrequencies) {
  for_each_dimension([]<int Dim>() {
    const GradientKernel<Dim> kernel(Kernel::zero_dc);
    // S ~ f^6: halving f divides it by 64, to 2 % at f = 0.02.
    EXPECT_TRUE(within(0.02, kernel.power_spectrum(0.02) / kernel.power_spectrum(0.01), 64.0));
    const GradientKernel<Dim> published(Kernel::kensler);
    EXPECT_TRUE(within(0.05, published.power_spectrum(0.02) / published.power_spectrum(0.01), 4.0));
  });
}

TEST(GradientKernel, RadialPeakIsTheMaximum) {
  for_each_kernel([]<int Dim>(const GradientKernel<Dim>& kernel, double) {
    const auto radial = [&](double f) { return std::pow(f, Dim - 1) * kernel.power_spectrum(f); };
    for (double f = 0.005; f < 3.0; f += 0.005) {
      EXPECT_LE(radial(f), radial(kernel.radial_peak()) * (1.0 + 1e-12));
    }
  });
}

TEST(GradientKernel, ExcessKurtosisIsThatOfTheMixtureOverTheCell) {
  for_each_kernel([]<int Dim>(const GradientKernel<Dim>& kernel, double cell) {
    // E[n^4] at x: 3 variance^2, and the fourth cumulants -6 |v|^4 / (n^2 (n + 2)) of the terms.
    const double squared = mean_over_cell<Dim>(
        cell, [&](const Vec<Dim>& x) { return std::pow(variance_at(kernel, cell, x), 2); });
    const double quartic =
        unit_sphere_area(Dim) * std::pow(cell, -Dim) *
        integrate([&](double r) { return std::pow(r, Dim + 3) * std::pow(kernel.value(r), 4); }, 0.0, 2.0,
                  10);
    const double n = Dim;
    const double fourth = 3.0 * squared - 6.0 / (n * n * (n + 2.0)) * quartic;
    EXPECT_NEAR(kernel.excess_kurtosis(), fourth / std::pow(kernel.mean_variance(), 2) - 3.0, 1e-6);
  });
}

TEST(GradientKernel, BandLeavesHalfAThousandthOnEitherSide) {
  for_each_kernel([]<int Dim>(const GradientKernel<Dim>& kernel, double) {
    const auto band = kernel.band();
    EXPECT_TRUE(within(1e-6, radial_power(kernel, 0.0, band.lower), 5e-4 * kernel.mean_variance()));
    // What is past f = 4, about 1e-7 of the variance, is not looked at for the upper limit.
    EXPECT_TRUE(within(1e-3, radial_power(kernel, band.upper, 8.0), 5e-4 * kernel.mean_variance()));
  });
}

}  // namespace
}  // namespace solidnoise::gradient_kernel_test
