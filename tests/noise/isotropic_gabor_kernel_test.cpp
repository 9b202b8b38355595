#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "support/golden.h"
#include "support/relative_error.h"

namespace solidnoise::isotropic_gabor_kernel_test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;

// Golden values are exact to the last digit; closed forms in double precision lose a few.
constexpr double kExact = 1e-9;

template <int Dim>
IsotropicGaborKernel<Dim> kernel_of(const json& golden_case) {
  return {golden_case["K"], golden_case["F0"], golden_case["a"]};
}

// Integral over space of a radial function that is negligible beyond some radius.
template <typename Function>
double space_integral(int n, double end, const Function& function) {
  return unit_sphere_area(n) *
         integrate([&](double r) { return function(r) * std::pow(r, n - 1); }, 0.0, end, 60);
}

TEST(IsotropicGaborKernel, ValueAndDerivativeAgreeWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = kernel_of<Dim>(expected);
    EXPECT_TRUE(within(kExact, kernel.peak(), expected["g0"]));
    for (const json& at : expected["kernel"]) {
      // Some golden radii are at a zero of the kernel, where only the absolute error means something.
      EXPECT_NEAR(kernel.value(at["r"]), at["g"],
                  kExact * std::abs(at["g"].get<double>()) + 1e-15 * kernel.peak());
      EXPECT_TRUE(within(kExact, kernel.derivative(at["r"]), at["dg_dr"]));
    }
  });
}

TEST(IsotropicGaborKernel, SpectrumAgreesWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = kernel_of<Dim>(expected);
    for (const json& at : expected["spectrum"]) {
      EXPECT_TRUE(within(kExact, kernel.spectrum(at["f"]), at["G"]));
    }
  });
}

TEST(IsotropicGaborKernel, SpectrumIsTheFourierTransformOfTheValue) {
  for_each_gabor_case([]<int Dim>(const json& golden_case) {
    const auto kernel = kernel_of<Dim>(golden_case);
    for (const double share : {0.0, 0.4, 1.0, 1.7, 3.0}) {
      const double f = share * kernel.frequency();
      const double transform = space_integral(Dim, 4.0 / kernel.a(), [&](double r) {
        return kernel.value(r) * mean_cosine(Dim, 2.0 * kPi * f * r);
      });
      // The quadrature is exact to some 1e-14 of the largest value.
      EXPECT_NEAR(transform, kernel.spectrum(f), 1e-12 * kernel.spectrum(kernel.frequency()));
    }
  });
}

TEST(IsotropicGaborKernel, EnergyAgreesWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    EXPECT_TRUE(within(kExact, kernel_of<Dim>(expected).energy(), expected["int_g2_iso"]));
  });
}

TEST(IsotropicGaborKernel, MomentsAreIntegralsOfPowers) {
  for_each_gabor_case([]<int Dim>(const json& golden_case) {
    const auto kernel = kernel_of<Dim>(golden_case);
    const double end = 4.0 / kernel.a();
    EXPECT_TRUE(within(1e-12, kernel.energy(),
                       space_integral(Dim, end, [&](double r) { return std::pow(kernel.value(r), 2); })));
    EXPECT_TRUE(within(1e-12, kernel.fourth_moment(),
                       space_integral(Dim, end, [&](double r) { return std::pow(kernel.value(r), 4); })));
  });
}

TEST(IsotropicGaborKernel, RelativeErrorAndItsRadiusAgreeWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = kernel_of<Dim>(expected);
    for (const json& at : expected["relerr_at"]) {
      EXPECT_TRUE(within(kExact, kernel.relative_error(at["r"]), at["iso"]));
    }
    EXPECT_TRUE(within(kExact, kernel.radius_for_error(0.05), expected["radius"]["iso_relerr_0.05"]));
    EXPECT_TRUE(within(kExact, kernel.radius_for_error(0.02), expected["radius"]["iso_relerr_0.02"]));
  });
}

TEST(IsotropicGaborKernel, RadiusForErrorReachesSmallErrors) {
  const auto kernel = IsotropicGaborKernel<3>::with_unit_peak(4.0, 3.0);
  for (const double error : {1e-10, 1e-7, 1e-4, 0.3, 0.99}) {
    EXPECT_TRUE(within(1e-9, kernel.relative_error(kernel.radius_for_error(error)), error));
  }
}

TEST(IsotropicGaborKernel, AutocorrelationAgreesWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = kernel_of<Dim>(expected);
    for (const json& at : expected["noise"]["cov_iso_over_lambdaEW2"]) {
      // Some golden lags are at a zero, where only the absolute error means something.
      EXPECT_NEAR(kernel.autocorrelation(at["r"]), at["R"],
                  kExact * std::abs(at["R"].get<double>()) + 1e-13 * kernel.energy());
    }
  });
}

TEST(IsotropicGaborKernel, FilteredParametersAndSpectrumAgreeWithGoldenValues) {
  for_each_gabor_case([]<int Dim>(const json& expected) {
    const auto kernel = kernel_of<Dim>(expected);
    const json& filter = expected["filter"];
    const auto filtered = kernel.filtered(filter["b"]);
    EXPECT_TRUE(within(kExact, filtered.amplitude(), filter["K1"]));
    EXPECT_TRUE(within(kExact, filtered.a(), filter["a1"]));
    EXPECT_TRUE(within(kExact, filtered.frequency(), filter["F1"]));
    EXPECT_TRUE(within(kExact, filtered.energy() / kernel.energy(), filter["var_ratio"]));
    for (const json& at : filter["G_filtered"]) {
      EXPECT_TRUE(within(kExact, filtered.spectrum(at["f"]), at["G"]));
    }
  });
}

TEST(IsotropicGaborKernel, FilteringMultipliesTheSpectrumByTheResponse) {
  for_each_gabor_case([]<int Dim>(const json& golden_case) {
    const auto kernel = kernel_of<Dim>(golden_case);
    for (const double b : {0.3 * kernel.a(), kernel.a(), 5.0 * kernel.frequency()}) {
      const auto filtered = kernel.filtered(b);
      for (const double share : {0.0, 0.5, 1.0, 1.5}) {
        const double f = share * kernel.frequency();
        EXPECT_TRUE(
            within(1e-12, filtered.spectrum(f), kernel.spectrum(f) * std::exp(-kPi * f * f / (b * b))));
      }
    }
  });
}

TEST(IsotropicGaborKernel, UnitPeakIsOne) {
  EXPECT_DOUBLE_EQ(IsotropicGaborKernel<1>::with_unit_peak(7.0, 2.0).value(0.0), 1.0);
  EXPECT_DOUBLE_EQ(IsotropicGaborKernel<2>::with_unit_peak(7.0, 2.0).value(0.0), 1.0);
  EXPECT_DOUBLE_EQ(IsotropicGaborKernel<3>::with_unit_peak(7.0, 2.0).value(0.0), 1.0);
  EXPECT_DOUBLE_EQ(IsotropicGaborKernel<4>::with_unit_peak(7.0, 2.0).value(0.0), 1.0);
}

TEST(IsotropicGaborKernel, NarrowBandsNeitherOverflowNorLoseDigits) {
  // F0/a = 27 is a bandwidth of 0.05 octaves: exp(pi F0^2 / a^2) alone would be 1e1000.
  const auto kernel = IsotropicGaborKernel<3>::with_unit_peak(27.0, 1.0);
  const double energy = space_integral(3, 4.0, [&](double r) { return std::pow(kernel.value(r), 2); });
  EXPECT_TRUE(within(1e-11, kernel.energy(), energy));
  const double parseval =
      unit_sphere_area(3) *
      integrate([&](double f) { return std::pow(f * kernel.spectrum(f), 2); }, 23.0, 31.0, 20);
  EXPECT_TRUE(within(1e-11, parseval, energy));
}

TEST(IsotropicGaborKernel, RefusesParametersThatMakeNoKernel) {
  EXPECT_THROW(IsotropicGaborKernel<2>(-1.0, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(IsotropicGaborKernel<2>(1.0, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(IsotropicGaborKernel<2>(1.0, 1.0, -1.0), std::invalid_argument);
  EXPECT_THROW(IsotropicGaborKernel<2>(1.0, std::nan(""), 1.0), std::invalid_argument);
  const IsotropicGaborKernel<2> kernel(1.0, 1.0, 1.0);
  EXPECT_THROW(kernel.radius_for_error(0.0), std::invalid_argument);
  EXPECT_THROW(kernel.filtered(0.0), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::isotropic_gabor_kernel_test
