// FactoredPolynomial: adapted coefficients give the polynomial that they were made of.
#include "solidnoise/noise/kernel/factored_polynomial.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise {
namespace {

double chebyshev_sum(const std::vector<double>& coefficients, double u) {
  double sum = 0.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    sum += coefficients[k] * std::cos(static_cast<double>(k) * std::acos(u));
  }
  return sum;
}

// The largest error over [0, 1], relative to the largest value.
double relative_error(const std::vector<double>& chebyshev) {
  const FactoredPolynomial factored(chebyshev);
  double error = 0.0;
  double largest = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const auto x = static_cast<float>(k / 1000.0);
    const double exact = chebyshev_sum(chebyshev, 2.0 * static_cast<double>(x) - 1.0);
    error = std::fmax(error, std::abs(factored.leading() * static_cast<double>(factored.monic(x)) - exact));
    largest = std::fmax(largest, std::abs(exact));
  }
  return error / largest;
}

TEST(FactoredPolynomial, IsThePolynomialForEveryDegree) {
  // Roots all over the interval and off it. A wrong coefficient shows as an error of its own size, 0.1 or so;
  // rounding is amplified by intermediate results of up to a hundred times the largest value.
  for (int degree = 1; degree <= 12; ++degree) {
    std::vector<double> wave(static_cast<std::size_t>(degree) + 1, 0.1);
    wave.back() = 1.0;
    EXPECT_LT(relative_error(wave), 2e-5) << degree << ", real roots";
    std::vector<double> hill;
    for (int k = 0; k <= degree; ++k) hill.push_back(std::pow(0.5, k));
    EXPECT_LT(relative_error(hill), 2e-5) << degree << ", complex roots";
  }
}

TEST(FactoredPolynomial, HasAsManyCoefficientsAsItsDegree) {
  for (int degree = 1; degree <= 12; ++degree) {
    const FactoredPolynomial::Shape shape(degree);
    EXPECT_EQ(6 * shape.sextics + shape.even + shape.linear, degree);
    const FactoredPolynomial factored(std::vector<double>(static_cast<std::size_t>(degree) + 1, 1.0));
    EXPECT_EQ(factored.degree(), degree);
    EXPECT_EQ(factored.coefficients().size(), static_cast<std::size_t>(degree));
  }
}

TEST(FactoredPolynomial, IsAccurateForTheKernelsOfUsualBandwidths) {
  // The noises take it up to an RMS error of 2e-5 of the kernel, of which all but the narrowest bands must be
  // well within, or they would be slow.
  for (const double octaves : {0.5, 0.7, 1.0, 1.5, 2.0, 3.0}) {
    const auto gabor = IsotropicGaborKernel<3>::with_unit_peak(1.0, gaussian_parameter(1.0, octaves));
    for (const double error : {0.01, 0.02, 0.05}) {
      const CompactKernel kernel = compact_kernel(gabor, error);
      const FactoredPolynomial factored(kernel.chebyshev_coefficients());
      const double rounding = kernel.rounding_error(
          [&](float t) { return static_cast<float>(factored.leading()) * factored.monic(t); });
      EXPECT_LT(rounding, 1e-5) << octaves << " octaves, error " << error << ", degree " << kernel.degree();
    }
  }
}

}  // namespace
}  // namespace solidnoise
