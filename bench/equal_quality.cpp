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

template <typename Noise, typename Options>
std::shared_ptr<const solidnoise::Noise<3>> like_kensler(Options options) {
  options.frequency = kensler().options().frequency;
  options.bandwidth = kBandwidth;
  return std::make_shared<Noise>(options);
}

// Of a Poisson process the excess kurtosis goes with the reciprocal of the impulses.
template <typename Noise, typename Options>
std::shared_ptr<const solidnoise::Noise<3>> poisson_like_strata(Options options, double kurtosis) {
  constexpr double kSome = 100.0;
  options.impulses_process = ImpulseSpread::poisson;
  options.impulses = kSome;
  options.impulses *= like_kensler<Noise>(options)->excess_kurtosis() / kurtosis;
  return like_kensler<Noise>(options);
}

std::shared_ptr<const Noise<3>> make(Generator generator, double error) {
  switch (generator) {
    case Generator::isotropic:
      return like_kensler<GaborNoise<3>>(GaborNoiseOptions{.error = error});
    case Generator::directions:
      return like_kensler<OrientedGaborNoise<3>>(OrientedGaborNoiseOptions{.error = error});
    case Generator::isotropic_poisson:
      return poisson_like_strata<GaborNoise<3>>(GaborNoiseOptions{.error = error}, 0.01);
    case Generator::directions_poisson:
      return poisson_like_strata<OrientedGaborNoise<3>>(OrientedGaborNoiseOptions{.error = error}, 0.03);
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
