#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

// Panels for an oscillating integrand of this many cycles under a Gaussian about as wide as the interval.
int panels_for(double cycles) {
  return 6 + static_cast<int>(cycles);
}

// exp(-2 pi 3^2) = 3e-25: what lies 3 widths from a squared Gaussian's centre, or is 9 larger in the square
// of the distance, counts for nothing.
constexpr double kNegligible = 3.0;

}  // namespace

template <int Dim>
IsotropicGaborKernel<Dim>::IsotropicGaborKernel(double amplitude, double frequency, double a)
    : amplitude_(amplitude), frequency_(frequency), a_(a) {
  require_at_least("amplitude", amplitude, 0.0);
  require_positive("frequency", frequency, "cycles per world unit");
  require_positive("a", a, "cycles per world unit");
  peak_ = amplitude * unit_sphere_area(Dim) * std::pow(frequency, Dim - 1);
}

template <int Dim>
IsotropicGaborKernel<Dim> IsotropicGaborKernel<Dim>::with_unit_peak(double frequency, double a) {
  require_positive("frequency", frequency, "cycles per world unit");
  return IsotropicGaborKernel(1.0 / (unit_sphere_area(Dim) * std::pow(frequency, Dim - 1)), frequency, a);
}

template <int Dim>
double IsotropicGaborKernel<Dim>::value(double r) const {
  return peak_ * std::exp(-kPi * squared(a_ * r)) * mean_cosine(Dim, 2.0 * kPi * frequency_ * r);
}

template <int Dim>
double IsotropicGaborKernel<Dim>::derivative(double r) const {
  const double z = 2.0 * kPi * frequency_ * r;
  const double gaussian = peak_ * std::exp(-kPi * squared(a_ * r));
  return -2.0 * kPi * r * gaussian *
         (a_ * a_ * mean_cosine(Dim, z) + 2.0 * kPi / Dim * squared(frequency_) * mean_cosine(Dim + 2, z));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::spectrum(double f) const {
  f = std::abs(f);
  return peak_ * std::pow(a_, -Dim) * std::exp(-kPi * squared((f - frequency_) / a_)) *
         mean_exponential_scaled(Dim, 2.0 * kPi * frequency_ * f / squared(a_));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::energy() const {
  return squared(peak_) * std::pow(std::numbers::sqrt2 * a_, -Dim) *
         mean_exponential_scaled(Dim, kPi * squared(frequency_ / a_));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::fourth_moment() const {
  const auto integrand = [this](double r) { return squared(squared(value(r))) * std::pow(r, Dim - 1); };
  // The fourth power of the Gaussian is below 1e-24 at twice a squared Gaussian's reach over sqrt(2).
  const double reach = kNegligible / (a_ * std::numbers::sqrt2);
  return unit_sphere_area(Dim) * integrate(integrand, 0.0, reach, panels_for(4.0 * frequency_ * reach));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::gradient_energy() const {
  const auto integrand = [this](double r) { return squared(derivative(r)) * std::pow(r, Dim - 1); };
  const double reach = kNegligible / a_;
  return unit_sphere_area(Dim) * integrate(integrand, 0.0, reach, panels_for(2.0 * frequency_ * reach));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::autocorrelation(double r) const {
  // The Fourier transform of G^2, a radial function.
  const auto integrand = [this, r](double f) {
    return squared(spectrum(f)) * std::pow(f, Dim - 1) * mean_cosine(Dim, 2.0 * kPi * f * r);
  };
  const double lower = std::max(0.0, frequency_ - kNegligible * a_);
  const double upper = frequency_ + kNegligible * a_;
  return unit_sphere_area(Dim) *
         integrate(integrand, lower, upper, panels_for(4.0 + std::abs(r) * (upper - lower)));
}

template <int Dim>
double IsotropicGaborKernel<Dim>::relative_error(double radius) const {
  // The tail itself, not 1 minus the head, which would lose its digits for small errors.
  const auto integrand = [this](double r) { return squared(value(r)) * std::pow(r, Dim - 1); };
  const double end = std::hypot(radius, kNegligible / a_);
  const int panels = panels_for(2.0 * frequency_ * (end - radius));
  return std::sqrt(unit_sphere_area(Dim) * integrate(integrand, radius, end, panels) / energy());
}

template <int Dim>
double IsotropicGaborKernel<Dim>::radius_for_error(double error) const {
  require_in_range("error", error, 1e-12, 1.0);
  const auto excess = [this, error](double radius) { return relative_error(radius) - error; };
  double upper = 1.0 / a_;
  while (excess(upper) > 0.0) upper *= 1.5;
  return bisect(excess, 0.0, upper);
}

template <int Dim>
IsotropicGaborKernel<Dim> IsotropicGaborKernel<Dim>::filtered(double b) const {
  require_positive("b", b, "cycles per world unit");
  const double sum = a_ * a_ + b * b;
  return IsotropicGaborKernel(
      amplitude_ * std::pow(sum / (b * b), 0.5 * Dim - 1.0) * std::exp(-kPi * squared(frequency_) / sum),
      frequency_ * b * b / sum, a_ * b / std::sqrt(sum));
}

template class IsotropicGaborKernel<1>;
template class IsotropicGaborKernel<2>;
template class IsotropicGaborKernel<3>;
template class IsotropicGaborKernel<4>;

}  // namespace solidnoise
