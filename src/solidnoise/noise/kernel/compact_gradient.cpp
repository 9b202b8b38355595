#include "solidnoise/noise/kernel/compact_gradient.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

constexpr double kNegligibleFrom = 4.0;  // 1 / a: exp(-2 pi 4^2) of a Gaussian's square is beyond

// Of a radial slope over a shell, relative to the kernel's over space: the root of the integrals' ratio.
template <int Dim, typename Slope>
double relative_slope(const IsotropicGaborKernel<Dim>& kernel, double from, double to, const Slope& slope) {
  const auto square = [&](double r) { return std::pow(slope(r), 2) * std::pow(r, Dim - 1); };
  const int panels = 4 + static_cast<int>(kernel.frequency() * (to - from));
  return std::sqrt(unit_sphere_area(Dim) * integrate(square, from, to, panels) / kernel.gradient_energy());
}

}  // namespace

template <int Dim>
double gradient_error(const IsotropicGaborKernel<Dim>& kernel, const CompactKernel& compact) {
  const auto missing = [&](double r) { return kernel.derivative(r) - compact.derivative(r); };
  return std::hypot(relative_slope(kernel, 0.0, compact.radius(), missing),
                    gradient_beyond(kernel, compact.radius()));
}

template <int Dim>
double gradient_beyond(const IsotropicGaborKernel<Dim>& kernel, double radius) {
  const double end = std::max(radius, kNegligibleFrom / kernel.a());
  return relative_slope(kernel, radius, end, [&](double r) { return kernel.derivative(r); });
}

double gradient_error(double a, double frequency, int dimensions, const CompactKernel& envelope) {
  // Along one axis: of the Gaussian's square and of its slope's, and of their products with the envelope's.
  // The envelope's square is what it has of the Gaussian, for it is the best one.
  const double energy = 1.0 / (std::numbers::sqrt2 * a);
  const double common = envelope.energy();
  const double slope_energy = kPi * a * a * energy;
  const double slope_common =
      2.0 * integrate(
                [&](double d) {
                  return -2.0 * kPi * a * a * d * std::exp(-kPi * a * a * d * d) * envelope.derivative(d);
                },
                0.0, envelope.radius(), 4);
  const int others = dimensions - 1;
  const double wave = std::pow(2.0 * kPi * frequency, 2);
  const double whole =
      dimensions * slope_energy * std::pow(energy, others) + wave * std::pow(energy, dimensions);
  const double missing =
      dimensions * (slope_energy * std::pow(energy, others) - 2.0 * slope_common * std::pow(common, others) +
                    envelope.gradient_energy() * std::pow(common, others)) +
      wave * (std::pow(energy, dimensions) - std::pow(common, dimensions));
  return std::sqrt(missing / whole);
}

double gradient_error(double a, double frequency, const CompactKernel& gaussian) {
  const int n = gaussian.dimensions();
  const double energy = std::pow(std::numbers::sqrt2 * a, -n);
  const double slope_energy = n * kPi * a * a * energy;
  const auto common = [&](double r) {
    const double slope = -2.0 * kPi * a * a * r * std::exp(-kPi * a * a * r * r);
    return slope * gaussian.derivative(r) * std::pow(r, n - 1);
  };
  const double slope_common = unit_sphere_area(n) * integrate(common, 0.0, gaussian.radius(), 4);
  const double wave = std::pow(2.0 * kPi * frequency, 2);
  const double missing =
      slope_energy - 2.0 * slope_common + gaussian.gradient_energy() + wave * (energy - gaussian.energy());
  return std::sqrt(missing / (slope_energy + wave * energy));
}

namespace {

// What make(e) makes within an error e of values, e such that of_gradient() of it is within `error`.
template <typename Make, typename OfGradient>
CompactKernel within_gradient(double error, const Make& make, const OfGradient& of_gradient) {
  constexpr double kLeast = 1e-5;  // that envelopes can be made with
  constexpr double kMargin = 0.99;
  double own = error;
  CompactKernel envelope = make(own);
  for (double found = of_gradient(envelope); found > error && own > kLeast; found = of_gradient(envelope)) {
    own = std::max(kLeast, own * kMargin * error / found);
    envelope = make(own);
  }
  return envelope;
}

}  // namespace

CompactKernel compact_envelope_with_gradient(double a, double frequency, int dimensions, double error) {
  return within_gradient(
      error, [&](double own) { return compact_envelope(a, dimensions, own); },
      [&](const CompactKernel& envelope) { return gradient_error(a, frequency, dimensions, envelope); });
}

CompactKernel compact_gaussian_with_gradient(double a, double frequency, int dimensions, double error) {
  return within_gradient(
      error, [&](double own) { return compact_gaussian(a, dimensions, own); },
      [&](const CompactKernel& gaussian) { return gradient_error(a, frequency, gaussian); });
}

template double gradient_error(const IsotropicGaborKernel<1>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<2>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<3>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<4>&, const CompactKernel&);

template double gradient_beyond(const IsotropicGaborKernel<1>&, double);
template double gradient_beyond(const IsotropicGaborKernel<2>&, double);
template double gradient_beyond(const IsotropicGaborKernel<3>&, double);
template double gradient_beyond(const IsotropicGaborKernel<4>&, double);

}  // namespace solidnoise
