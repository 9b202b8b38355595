#include <cmath>

#include "quality_cases.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"

namespace solidnoise::bench {
namespace {

constexpr double kVoxelsPerCell = 12.0;
constexpr double kBandwidth = 0.9;
constexpr double kError = 0.02;

GradientNoise<3> kensler() {
  const double frequency = GradientNoise<3>({.frequency = 1.0}).lattice_spacing()[0] / kVoxelsPerCell;
  return GradientNoise<3>({.frequency = frequency});
}

// Excess kurtosis goes with 1 / impulses.
template <typename Noise, typename Options>
std::shared_ptr<const solidnoise::Noise<3>> as_gaussian_as_kensler(Options options) {
  const GradientNoise<3> other = kensler();
  options.frequency = other.options().frequency;
  options.bandwidth = kBandwidth;
  const Noise with_default(options);
  options.impulses =
      with_default.impulses_per_kernel() * with_default.excess_kurtosis() / std::abs(other.excess_kurtosis());
  return std::make_shared<Noise>(options);
}

std::shared_ptr<const Noise<3>> make(Generator generator, double error) {
  switch (generator) {
    case Generator::isotropic:
      return as_gaussian_as_kensler<GaborNoise<3>>(GaborNoiseOptions{.error = error});
    case Generator::directions:
      return as_gaussian_as_kensler<OrientedGaborNoise<3>>(OrientedGaborNoiseOptions{.error = error});
    case Generator::kensler:
      break;
  }
  return std::make_shared<GradientNoise<3>>(kensler());
}

}  // namespace

std::shared_ptr<const Noise<3>> equal_quality_direct(Generator generator) {
  return make(generator, kError);
}

std::shared_ptr<const Noise<3>> equal_quality_budget(Generator generator) {
  const ErrorBudget budget(kError);
  return interpolate<3>(make(generator, budget.truncation), {}, budget.interpolation);
}

}  // namespace solidnoise::bench
