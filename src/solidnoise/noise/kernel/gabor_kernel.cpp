#include "solidnoise/noise/kernel/gabor_kernel.h"

#include <cmath>
#include <numbers>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

template <int Dim>
double dot(const Vec<Dim>& x, const Vec<Dim>& y) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += x[axis] * y[axis];
  return sum;
}

}  // namespace

template <int Dim>
RandomPhaseGaborKernel<Dim>::RandomPhaseGaborKernel(double amplitude, double a, const Vec<Dim>& frequency)
    : amplitude_(amplitude), a_(a), frequency_(frequency) {
  require_at_least("amplitude", amplitude, 0.0);
  require_positive("a", a, "cycles per world unit");
  for (int axis = 0; axis < Dim; ++axis) require_finite("frequency", frequency[axis]);
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::power_spectrum(const Vec<Dim>& f) const {
  const double above = std::exp(-2.0 * kPi * squared_length<Dim>(f - frequency_) / (a_ * a_));
  const double below = std::exp(-2.0 * kPi * squared_length<Dim>(f + frequency_) / (a_ * a_));
  return 0.25 * squared(amplitude_) * std::pow(a_, -2 * Dim) * (above + below);
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::isotropic_power_spectrum(double f) const {
  const double f0 = std::sqrt(squared_length<Dim>(frequency_));
  f = std::abs(f);
  return 0.5 * squared(amplitude_) * std::pow(a_, -2 * Dim) * std::exp(-2.0 * kPi * squared((f - f0) / a_)) *
         mean_exponential_scaled(Dim, 4.0 * kPi * f0 * f / (a_ * a_));
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::energy() const {
  return 0.5 * squared(amplitude_) * std::pow(std::numbers::sqrt2 * a_, -Dim);
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::fourth_moment() const {
  return 0.375 * squared(squared(amplitude_)) * std::pow(2.0 * a_, -Dim);
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::autocorrelation(const Vec<Dim>& x) const {
  return energy() * std::exp(-0.5 * kPi * a_ * a_ * squared_length<Dim>(x)) *
         std::cos(2.0 * kPi * dot<Dim>(frequency_, x));
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::relative_error(double radius) const {
  return std::sqrt(regularized_gamma_q(0.5 * Dim, 2.0 * kPi * squared(a_ * radius)));
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::radius_for_error(double error) const {
  require_in_range("error", error, 1e-12, 1.0);
  const auto excess = [&](double radius) { return relative_error(radius) - error; };
  double upper = 1.0 / a_;
  while (excess(upper) > 0.0) upper *= 1.5;
  return bisect(excess, 0.0, upper);
}

template <int Dim>
RandomPhaseGaborKernel<Dim> RandomPhaseGaborKernel<Dim>::filtered(double b) const {
  require_positive("b", b, "cycles per world unit");
  const double sum = a_ * a_ + b * b;
  const double a = a_ * b / std::sqrt(sum);
  const double amplitude =
      amplitude_ * std::pow(a / a_, Dim) * std::exp(-kPi * squared_length<Dim>(frequency_) / sum);
  return {amplitude, a, frequency_ * (b * b / sum)};
}

template <int Dim>
EvenGaborKernel<Dim>::EvenGaborKernel(double a, double frequency) : a_(a), frequency_(frequency) {
  require_positive("a", a, "cycles per world unit");
  require_at_least("frequency", frequency, 0.0);
}

template <int Dim>
double EvenGaborKernel<Dim>::energy() const {
  return 0.5 * std::pow(std::numbers::sqrt2 * a_, -Dim) *
         (1.0 + std::exp(-2.0 * kPi * squared(frequency_ / a_)));
}

template <int Dim>
double EvenGaborKernel<Dim>::fourth_moment() const {
  const double wave = kPi * squared(frequency_ / a_);
  return std::pow(2.0 * a_, -Dim) * (0.375 + 0.5 * std::exp(-wave) + 0.125 * std::exp(-4.0 * wave));
}

// g^2 is a Gaussian times (1 + cos(4 pi w.x)) / 2: Gaussians at 0, 2 w and -2 w, whose products are Gaussians
// at 0, w, 2 w, -w and -2 w.
template <int Dim>
double EvenGaborKernel<Dim>::squared_power(double f) const {
  const auto at = [&](double center) {  // mean over directions
    return std::exp(-kPi * squared((f - center) / a_)) *
           mean_exponential_scaled(Dim, 2.0 * kPi * center * f / squared(a_));
  };
  const double wave = kPi * squared(frequency_ / a_);
  const double sum = (1.0 + 0.5 * std::exp(-4.0 * wave)) * at(0.0) + 2.0 * std::exp(-wave) * at(frequency_) +
                     0.5 * at(2.0 * frequency_);
  return 0.25 * std::pow(2.0 * squared(a_), -Dim) * sum;
}

template <int Dim>
double EvenGaborKernel<Dim>::radius_for_error(double error) const {
  return RandomPhaseGaborKernel<Dim>(1.0, a_, Vec<Dim>(0.0)).radius_for_error(error);
}

template class EvenGaborKernel<1>;
template class EvenGaborKernel<2>;
template class EvenGaborKernel<3>;
template class EvenGaborKernel<4>;

template class RandomPhaseGaborKernel<1>;
template class RandomPhaseGaborKernel<2>;
template class RandomPhaseGaborKernel<3>;
template class RandomPhaseGaborKernel<4>;

}  // namespace solidnoise
