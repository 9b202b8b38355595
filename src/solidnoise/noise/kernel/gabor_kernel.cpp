#include "solidnoise/noise/kernel/gabor_kernel.h"

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

template <int Dim>
void validate(double amplitude, double a, const Vec<Dim>& frequency) {
  require_at_least("amplitude", amplitude, 0.0);
  require_positive("a", a, "cycles per world unit");
  for (int axis = 0; axis < Dim; ++axis) require_finite("frequency", frequency[axis]);
}

double gaussian_radius(double a, double fraction) {
  require_in_range("fraction", fraction, 0.0, 1.0);
  return std::sqrt(-std::log(fraction) / kPi) / a;
}

// Where relative_error() of a kernel of Gaussian parameter a falls to `error`.
template <typename Kernel>
double solve_radius(const Kernel& kernel, double a, double error) {
  require_in_range("error", error, 1e-12, 1.0);
  const auto excess = [&](double radius) { return kernel.relative_error(radius) - error; };
  double upper = 1.0 / a;
  while (excess(upper) > 0.0) upper *= 1.5;
  return bisect(excess, 0.0, upper);
}

// What filtering with exp(-pi f^2 / b^2) makes of the parameters.
template <int Dim>
struct Filtered {
  Filtered(double amplitude_before, double a_before, const Vec<Dim>& frequency_before, double b) {
    require_positive("b", b, "cycles per world unit");
    const double sum = a_before * a_before + b * b;
    a = a_before * b / std::sqrt(sum);
    frequency = frequency_before * (b * b / sum);
    amplitude = amplitude_before * std::pow(a / a_before, Dim) *
                std::exp(-kPi * squared_length<Dim>(frequency_before) / sum);
  }

  double amplitude;
  double a;
  Vec<Dim> frequency;
};

}  // namespace

template <int Dim>
GaborKernel<Dim>::GaborKernel(double amplitude, double a, const Vec<Dim>& frequency, double phase)
    : amplitude_(amplitude), a_(a), frequency_(frequency), phase_(phase) {
  validate<Dim>(amplitude, a, frequency);
  require_finite("phase", phase);
}

template <int Dim>
double GaborKernel<Dim>::value(const Vec<Dim>& x) const {
  return amplitude_ * std::exp(-kPi * a_ * a_ * squared_length<Dim>(x)) *
         std::cos(2.0 * kPi * dot<Dim>(frequency_, x) + phase_);
}

template <int Dim>
Vec<Dim> GaborKernel<Dim>::gradient(const Vec<Dim>& x) const {
  const double gaussian = amplitude_ * std::exp(-kPi * a_ * a_ * squared_length<Dim>(x));
  const double angle = 2.0 * kPi * dot<Dim>(frequency_, x) + phase_;
  return -2.0 * kPi * gaussian * (a_ * a_ * std::cos(angle) * x + std::sin(angle) * frequency_);
}

template <int Dim>
std::complex<double> GaborKernel<Dim>::spectrum(const Vec<Dim>& f) const {
  const double above = std::exp(-kPi * squared_length<Dim>(f - frequency_) / (a_ * a_));
  const double below = std::exp(-kPi * squared_length<Dim>(f + frequency_) / (a_ * a_));
  return 0.5 * amplitude_ * std::pow(a_, -Dim) *
         (std::polar(1.0, phase_) * above + std::polar(1.0, -phase_) * below);
}

template <int Dim>
double GaborKernel<Dim>::energy() const {
  return 0.5 * squared(amplitude_) * std::pow(std::numbers::sqrt2 * a_, -Dim) *
         (1.0 + std::cos(2.0 * phase_) * std::exp(-2.0 * kPi * squared_length<Dim>(frequency_) / (a_ * a_)));
}

template <int Dim>
double GaborKernel<Dim>::envelope(double r) const {
  return amplitude_ * std::exp(-kPi * squared(a_ * r));
}

template <int Dim>
double GaborKernel<Dim>::radius_for_envelope(double fraction) const {
  return gaussian_radius(a_, fraction);
}

template <int Dim>
double GaborKernel<Dim>::relative_error(double radius) const {
  // g^2 averaged over directions is (1 + cos(2 phase) mean_cosine(4 pi F0 r)) / 2 times a Gaussian; the first
  // part is in closed form, the other is a wave of 2 F0 cycles per unit.
  const double z = 4.0 * kPi * std::sqrt(squared_length<Dim>(frequency_));
  const auto wave = [this, z](double r) {
    return std::exp(-2.0 * kPi * squared(a_ * r)) * mean_cosine(Dim, z * r) * std::pow(r, Dim - 1);
  };
  const double end = std::hypot(radius, 3.0 / a_);
  const int panels = 6 + static_cast<int>(z * (end - radius) / (2.0 * kPi));
  const double steady = std::pow(std::numbers::sqrt2 * a_, -Dim) *
                        regularized_gamma_q(0.5 * Dim, 2.0 * kPi * squared(a_ * radius));
  const double waving = std::cos(2.0 * phase_) * unit_sphere_area(Dim) * integrate(wave, radius, end, panels);
  return std::sqrt(0.5 * squared(amplitude_) * (steady + waving) / energy());
}

template <int Dim>
double GaborKernel<Dim>::radius_for_error(double error) const {
  return solve_radius(*this, a_, error);
}

template <int Dim>
GaborKernel<Dim> GaborKernel<Dim>::filtered(double b) const {
  const Filtered<Dim> after(amplitude_, a_, frequency_, b);
  return {after.amplitude, after.a, after.frequency, phase_};
}

template <int Dim>
RandomPhaseGaborKernel<Dim>::RandomPhaseGaborKernel(double amplitude, double a, const Vec<Dim>& frequency)
    : amplitude_(amplitude), a_(a), frequency_(frequency) {
  validate<Dim>(amplitude, a, frequency);
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
double RandomPhaseGaborKernel<Dim>::radius_for_envelope(double fraction) const {
  return gaussian_radius(a_, fraction);
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::relative_error(double radius) const {
  return std::sqrt(regularized_gamma_q(0.5 * Dim, 2.0 * kPi * squared(a_ * radius)));
}

template <int Dim>
double RandomPhaseGaborKernel<Dim>::radius_for_error(double error) const {
  return solve_radius(*this, a_, error);
}

template <int Dim>
RandomPhaseGaborKernel<Dim> RandomPhaseGaborKernel<Dim>::filtered(double b) const {
  const Filtered<Dim> after(amplitude_, a_, frequency_, b);
  return {after.amplitude, after.a, after.frequency};
}

template class GaborKernel<1>;
template class GaborKernel<2>;
template class GaborKernel<3>;
template class GaborKernel<4>;
template class RandomPhaseGaborKernel<1>;
template class RandomPhaseGaborKernel<2>;
template class RandomPhaseGaborKernel<3>;
template class RandomPhaseGaborKernel<4>;

}  // namespace solidnoise
