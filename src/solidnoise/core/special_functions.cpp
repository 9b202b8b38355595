#include "solidnoise/core/special_functions.h"

#include <cmath>
#include <limits>

#include "solidnoise/core/numerics.h"

namespace solidnoise {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Sum of q^k / (k! (n/2)(n/2 + 1)...(n/2 + k - 1)): the power series of both direction means, with
// q = -z^2/4 for the cosine and z^2/4 for the exponential.
double direction_mean_series(double half_n, double q) {
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; std::abs(term) > 0.25 * kEpsilon * std::abs(sum); ++k) {
    term *= q / (k * (half_n + k - 1));
    sum += term;
  }
  return sum;
}

// sqrt(2 pi x) exp(-x) I_order(x) by its asymptotic series (Abramowitz and Stegun 9.7.1). For x >= 30 and
// orders up to 4 the smallest term is far below one rounding error.
double scaled_i_asymptotic_series(double order, double x) {
  const double mu = 4.0 * order * order;
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; k < 60 && std::abs(term) > 0.25 * kEpsilon * std::abs(sum); ++k) {
    const double odd = 2.0 * k - 1.0;
    term *= (odd * odd - mu) / (8.0 * k * x);
    sum += term;
  }
  return sum;
}

constexpr double kAsymptoticFrom = 30.0;

// P(s, x) by its power series, for x < s + 1.
double gamma_p_series(double s, double x) {
  double term = 1.0 / s;
  double sum = term;
  for (int k = 1; term > 0.25 * kEpsilon * sum; ++k) {
    term *= x / (s + k);
    sum += term;
  }
  return sum * std::exp(s * std::log(x) - x - std::lgamma(s));
}

// Q(s, x) by its continued fraction (Abramowitz and Stegun 6.5.31) in Lentz's form, for x >= s + 1.
double gamma_q_fraction(double s, double x) {
  double b = x + 1.0 - s;
  double c = 1.0 / std::numeric_limits<double>::min();
  double d = 1.0 / b;
  double product = d;
  for (int k = 1; k < 10000; ++k) {
    const double numerator = -k * (k - s);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    product *= c * d;
    if (std::abs(c * d - 1.0) < 2.0 * kEpsilon) break;
  }
  return product * std::exp(s * std::log(x) - x - std::lgamma(s));
}

}  // namespace

double unit_sphere_area(int n) {
  return 2.0 * std::pow(kPi, 0.5 * n) / std::tgamma(0.5 * n);
}

double unit_ball_volume(int n) {
  return unit_sphere_area(n) / n;
}

double bessel_i_scaled(double order, double x) {
  if (x >= kAsymptoticFrom) return scaled_i_asymptotic_series(order, x) / std::sqrt(2.0 * kPi * x);
  return std::exp(-x) * std::pow(0.5 * x, order) / std::tgamma(order + 1.0) *
         direction_mean_series(order + 1.0, 0.25 * x * x);
}

double mean_cosine(int n, double z) {
  z = std::abs(z);
  if (n == 1) return std::cos(z);
  if (n == 2) return ::j0(z);
  if (z < 1.0) return direction_mean_series(0.5 * n, -0.25 * z * z);
  if (n == 3) return std::sin(z) / z;
  if (n == 4) return 2.0 * ::j1(z) / z;
  if (n == 5) return 3.0 * (std::sin(z) / z - std::cos(z)) / (z * z);
  if (n == 6) return 8.0 * ::jn(2, z) / (z * z);
  const double order = 0.5 * n - 1.0;
  return std::tgamma(0.5 * n) * std::pow(2.0 / z, order) * std::cyl_bessel_j(order, z);
}

double mean_exponential_scaled(int n, double z) {
  if (n == 1) return 0.5 * (1.0 + std::exp(-2.0 * z));
  if (n == 3) return z == 0.0 ? 1.0 : -0.5 * std::expm1(-2.0 * z) / z;
  const double order = 0.5 * n - 1.0;
  if (z < kAsymptoticFrom) return std::exp(-z) * direction_mean_series(0.5 * n, 0.25 * z * z);
  return std::tgamma(0.5 * n) * std::pow(2.0 / z, order) * bessel_i_scaled(order, z);
}

double regularized_gamma_q(double s, double x) {
  if (x <= 0.0) return 1.0;
  return x < s + 1.0 ? 1.0 - gamma_p_series(s, x) : gamma_q_fraction(s, x);
}

}  // namespace solidnoise
