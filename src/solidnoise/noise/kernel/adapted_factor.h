#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace solidnoise {

// The factors of a FactoredPolynomial.

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;

constexpr int kSextic = 6;  // the highest degree of a factor

// The adapted coefficients of the monic polynomial with these roots, conjugate where they are not real; 1, 2,
// 4 or 6 of them. Of the solutions for 6, the most accurate one.
std::vector<float> adapted_coefficients(const Roots& roots);

// The factor of a degree at x, from its adapted coefficients, in single precision.
float factor_value(int degree, const float* a, float x);

// Sum over [0, 1] of the squared error of value(x), in single precision, times x^4 as kernels take it;
// infinite if it is not a number.
template <typename Value, typename Exact>
double squared_error(const Value& value, const Exact& exact) {
  constexpr int kProbes = 64;
  double sum = 0.0;
  for (int k = 0; k < kProbes; ++k) {
    const float x = (static_cast<float>(k) + 0.5f) / kProbes;
    sum += std::pow(x, 4) * std::pow(static_cast<double>(value(x)) - exact(static_cast<double>(x)), 2);
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace solidnoise
