#include "solidnoise/noise/kernel/compact_gradient.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/core/numerics.h"

namespace solidnoise {
namespace {

constexpr double kNegligibleFrom = 4.0;  // 1 / a: exp(-2 pi 4^2) of a Gaussian's square is beyond

// make(e) for all but the largest e at which of_gradient() of it is at most `error`.
template <typename Make, typename OfGradient>
CompactKernel within(double error, const Make& make, const OfGradient& of_gradient) {
  constexpr double kLeast = 1e-5;  // that kernels can be made with
  constexpr double kMargin = 0.99;
  double own = error;
  CompactKernel kernel = make(own);
  for (double found = of_gradient(kernel); found > error && own > kLeast; found = of_gradient(kernel)) {
    own = std::max(kLeast, own * kMargin * error / found);
    kernel = make(own);
  }
  return kernel;
}

}  // namespace

template <int Dim>
double gradient_error(const IsotropicGaborKernel<Dim>& kernel, const CompactKernel& compact) {
  const double end = std::max(compact.radius(), kNegligibleFrom / kernel.a());
  const auto shells = [&](const auto& slope) {
    const auto shell = [&](double r) { return std::pow(slope(r), 2) * std::pow(r, Dim - 1); };
    const auto panels = [&](double from, double to) {
      return 4 + static_cast<int>(kernel.frequency() * (to - from));
    };
    // The compact kernel is smooth up to its radius, and beyond.
    return integrate(shell, 0.0, compact.radius(), panels(0.0, compact.radius())) +
           integrate(shell, compact.radius(), end, panels(compact.radius(), end));
  };
  const double missing = shells([&](double r) { return kernel.derivative(r) - compact.derivative(r); });
  return std::sqrt(missing / shells([&](double r) { return kernel.derivative(r); }));
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

template <int Dim>
CompactKernel compact_with_gradient(const IsotropicGaborKernel<Dim>& kernel, double error) {
  return within(
      error, [&](double own) { return compact_kernel(kernel, own); },
      [&](const CompactKernel& compact) { return gradient_error(kernel, compact); });
}

CompactKernel compact_with_gradient(double a, double frequency, int dimensions, double error) {
  return within(
      error, [&](double own) { return compact_envelope(a, dimensions, own); },
      [&](const CompactKernel& envelope) { return gradient_error(a, frequency, dimensions, envelope); });
}

template double gradient_error(const IsotropicGaborKernel<1>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<2>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<3>&, const CompactKernel&);
template double gradient_error(const IsotropicGaborKernel<4>&, const CompactKernel&);
template CompactKernel compact_with_gradient(const IsotropicGaborKernel<1>&, double);
template CompactKernel compact_with_gradient(const IsotropicGaborKernel<2>&, double);
template CompactKernel compact_with_gradient(const IsotropicGaborKernel<3>&, double);
template CompactKernel compact_with_gradient(const IsotropicGaborKernel<4>&, double);

}  // namespace solidnoise
