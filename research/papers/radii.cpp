#include "papers/radii.h"

#include <cmath>
#include <numbers>

#include "papers/paper_kernel.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise::papers {
namespace {

constexpr double kFar = 150.0;  // pixels; exp(-2 pi a^2 r^2) is below 1e-100 there
constexpr int kPanels = 60;

// Where the share of an integral beyond a radius is the square of the error.
template <typename Density>
double radius_of_error(double error, const Density& density) {
  const double whole = integrate(density, 0.0, kFar, kPanels);
  return bisect(
      [&](double radius) { return integrate(density, radius, kFar, kPanels) / whole - error * error; }, 1.0,
      100.0);
}

}  // namespace

Radii example_radii() {
  constexpr double kFraction = 0.05;
  constexpr double kError = 0.02;
  const IsotropicGaborKernel<2> isotropic(kAmplitude, kFrequency, kGaussian);
  const RandomPhaseGaborKernel<2> random_phase(kAmplitude, kGaussian, {kFrequency, 0.0});

  Radii radii;
  radii.anisotropic_envelope = random_phase.radius_for_envelope(kFraction);
  radii.isotropic_envelope = isotropic.asymptotic_envelope_radius(kFraction);
  radii.isotropic_envelope_exact =
      bisect([&](double r) { return isotropic.envelope(r) - kFraction * isotropic.peak(); }, 1.0, 100.0);
  radii.isotropic_envelope_printed = isotropic.asymptotic_envelope_radius(kFraction / kAmplitude);
  radii.printed_share_of_maximum =
      isotropic.asymptotic_envelope(radii.isotropic_envelope_printed) / isotropic.peak();

  radii.random_phase_error = random_phase.radius_for_error(kError);
  radii.isotropic_error = isotropic.radius_for_error(kError);
  radii.anisotropic_error = radius_of_error(kError, [](double r) {
    const double gaussian = std::exp(-2.0 * std::numbers::pi * kGaussian * kGaussian * r * r);
    return 0.5 * (1.0 + bessel_j(0.0, 4.0 * std::numbers::pi * kFrequency * r)) * gaussian * r;
  });
  radii.isotropic_error_printed = radius_of_error(kError, [&](double r) {
    const double value = isotropic.value(r);
    return value * value;
  });
  return radii;
}

double saving(double small, double large) {
  return 1.0 - (small / large) * (small / large);
}

}  // namespace solidnoise::papers
