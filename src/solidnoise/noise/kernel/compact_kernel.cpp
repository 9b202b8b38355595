#include "solidnoise/noise/kernel/compact_kernel.h"

#include <cmath>
#include <limits>
#include <utility>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

// Sum of c_k T_k(u), by Clenshaw's rule.
double chebyshev_sum(const std::vector<double>& coefficients, double u) {
  double next = 0.0;
  double after = 0.0;
  for (std::size_t k = coefficients.size() - 1; k > 0; --k) {
    const double current = coefficients[k] + 2.0 * u * next - after;
    after = next;
    next = current;
  }
  return coefficients[0] + u * next - after;
}

// Of a Chebyshev series S(u), d(t^2 S)/dt / t = 2 S + (1 + u) S'(u); t = (1 + u) / 2. The derivative by the
// recurrence c'_(k-1) = c'_(k+1) + 2 k c_k, c'_0 halved, and u T_k = (T_(k+1) + T_(k-1)) / 2, u T_0 = T_1.
std::vector<double> chebyshev_tapered_slope(const std::vector<double>& coefficients) {
  const std::size_t count = coefficients.size();
  std::vector<double> derivative(count + 1, 0.0);
  for (std::size_t k = count - 1; k > 0; --k) {
    derivative[k - 1] = derivative[k + 1] + 2.0 * static_cast<double>(k) * coefficients[k];
  }
  derivative[0] *= 0.5;
  std::vector<double> slope(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double below = k > 0 ? (k == 1 ? 1.0 : 0.5) * derivative[k - 1] : 0.0;
    slope[k] = 2.0 * coefficients[k] + derivative[k] + below + 0.5 * derivative[k + 1];
  }
  return slope;
}

// What is left of a polynomial in powers of v, divided by v + 1/2; it has that factor.
std::vector<double> divided_by_t(std::vector<double> powers) {
  for (std::size_t k = powers.size() - 1; k > 0; --k) powers[k - 1] -= 0.5 * powers[k];
  powers.erase(powers.begin());
  return powers;
}

// A Chebyshev series of 2 v, in powers of v.
std::vector<double> powers_of_half_argument(const std::vector<double>& coefficients) {
  const std::size_t count = coefficients.size();
  std::vector<double> powers(count, 0.0);
  // The polynomials T_k(2 v) in powers of v: T_(k+1) = 4 v T_k - T_(k-1).
  std::vector<double> previous(count, 0.0);
  std::vector<double> current(count, 0.0);
  std::vector<double> next(count, 0.0);
  current[0] = 1.0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i <= k; ++i) powers[i] += coefficients[k] * current[i];
    if (k + 1 == count) break;
    const double factor = k == 0 ? 2.0 : 4.0;
    for (std::size_t i = 0; i <= k + 1; ++i) {
      next[i] = (i > 0 ? factor * current[i - 1] : 0.0) - previous[i];
    }
    std::swap(previous, current);
    std::swap(current, next);
  }
  return powers;
}

}  // namespace

CompactKernel::CompactKernel(int dimensions, double radius, std::vector<double> chebyshev,
                             double relative_error, int taper)
    : dimensions_(dimensions),
      radius_(radius),
      taper_(taper),
      chebyshev_(std::move(chebyshev)),
      slope_(chebyshev_tapered_slope(chebyshev_)),
      power_(powers_of_half_argument(chebyshev_)),
      relative_error_(relative_error) {
  for (int k = 2; k < taper_; ++k) power_ = divided_by_t(power_);
  // The fourth power is a polynomial in r: a rule of half its degree is exact.
  shells_ = make_shells(4 * (degree() + taper_) + dimensions + 18);
  for (std::size_t i = 0; i < shells_.radii.size(); ++i) {
    const double g = value(shells_.radii[i]);
    energy_ += shells_.integrals[i] * g;
    fourth_moment_ += shells_.integrals[i] * g * g * g;
  }
  well_conditioned_ = horner_rounding() <= std::fmin(3e-5, 0.01 * relative_error);
}

double CompactKernel::value(double r) const {
  const double s = (r / radius_) * (r / radius_);
  if (s >= 1.0) return 0.0;
  const double t = 1.0 - s;
  return t * t * chebyshev_sum(chebyshev_, 1.0 - 2.0 * s);
}

double CompactKernel::derivative(double r) const {
  const double s = (r / radius_) * (r / radius_);
  if (s >= 1.0) return 0.0;
  const double t = 1.0 - s;
  return t * chebyshev_sum(slope_, 1.0 - 2.0 * s) * (-2.0 * r / (radius_ * radius_));
}

std::vector<double> CompactKernel::power_slope() const {
  // k P + (v + 1/2) P'
  std::vector<double> slope(power_.size());
  for (std::size_t i = 0; i < power_.size(); ++i) {
    slope[i] = (taper_ + static_cast<double>(i)) * power_[i];
    if (i > 0) slope[i - 1] += 0.5 * static_cast<double>(i) * power_[i];
  }
  return slope;
}

double CompactKernel::gradient_energy() const {
  // A polynomial in r of degree 4 (d + k) + n - 3: this rule is exact.
  const QuadratureRule rule = gauss_legendre(2 * (degree() + taper_) + dimensions_);
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double r = 0.5 * radius_ * (1.0 + rule.nodes[i]);
    const double slope = derivative(r);
    sum += rule.weights[i] * std::pow(r, dimensions_ - 1) * slope * slope;
  }
  return 0.5 * radius_ * unit_sphere_area(dimensions_) * sum;
}

// RMS error, relative to the kernel, that Horner's rule in single precision adds.
double CompactKernel::horner_rounding() const {
  for (const double c : power_) {
    if (std::abs(c) > std::numeric_limits<float>::max()) return std::numeric_limits<double>::infinity();
  }
  double squared_error = 0.0;
  for (std::size_t i = 0; i < shells_.radii.size(); ++i) {
    const double g = value(shells_.radii[i]);
    if (g == 0.0) continue;
    const auto t = static_cast<float>(1.0 - std::pow(shells_.radii[i] / radius_, 2));
    float polynomial = 0.0f;
    for (std::size_t k = power_.size(); k > 0; --k) {
      polynomial = std::fma(polynomial, t - 0.5f, static_cast<float>(power_[k - 1]));
    }
    for (int k = 0; k < taper_; ++k) polynomial *= t;
    squared_error += shells_.integrals[i] / g * std::pow(static_cast<double>(polynomial) - g, 2);
  }
  return std::sqrt(squared_error / energy_);
}

CompactKernel::Shells CompactKernel::make_shells(int count) const {
  const QuadratureRule rule = gauss_legendre(count);
  Shells shells;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double r = 0.5 * radius_ * (1.0 + rule.nodes[i]);
    const double area = unit_sphere_area(dimensions_) * std::pow(r, dimensions_ - 1);
    shells.radii.push_back(r);
    shells.integrals.push_back(0.5 * radius_ * rule.weights[i] * area * value(r));
  }
  return shells;
}

double CompactKernel::spectrum(double f) const {
  // Over the radius the wave is, to all digits, a polynomial of degree pi f R + 30; the kernel is one of
  // degree 2 (d + k). The nodes at hand are enough for up to a few times the kernel's own frequencies.
  const auto needed =
      static_cast<std::size_t>(degree() + dimensions_ + 18 + 0.5 * kPi * std::abs(f) * radius_);
  if (needed <= shells_.radii.size()) return transform(shells_, f);
  return transform(make_shells(static_cast<int>(needed)), f);
}

double CompactKernel::transform(const Shells& shells, double f) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < shells.radii.size(); ++i) {
    sum += shells.integrals[i] * mean_cosine(dimensions_, 2.0 * kPi * f * shells.radii[i]);
  }
  return sum;
}

}  // namespace solidnoise
