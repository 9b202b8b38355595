#include "solidnoise/noise/kernel/impulse_statistics.h"

#include <cmath>

#include "solidnoise/core/special_functions.h"

namespace solidnoise {

double impulse_density(int n, double impulses, double radius) {
  return impulses / (unit_ball_volume(n) * std::pow(radius, n));
}

double impulses_in_ball(int n, double density, double radius) {
  return density * unit_ball_volume(n) * std::pow(radius, n);
}

WeightMoments weight_moments(ImpulseWeights weights) {
  if (weights == ImpulseWeights::uniform) return {1.0 / 3.0, 1.0 / 5.0};
  return {1.0, 1.0};
}

WeightMoments turning(const WeightMoments& weights) {
  return {weights.second, 1.5 * weights.fourth};
}

double noise_variance(double density, double energy, const WeightMoments& weights) {
  return density * weights.second * energy;
}

double noise_excess_kurtosis(double density, const KernelMoments& kernel, const WeightMoments& weights) {
  const double variance = weights.second * kernel.second;
  const double cumulant =
      weights.fourth * kernel.fourth - 3.0 * weights.second * weights.second * kernel.overlap;
  return cumulant / (variance * variance) / density;
}

double density_for_excess_kurtosis(double kurtosis, const KernelMoments& kernel,
                                   const WeightMoments& weights) {
  const double of_weights = weights.fourth / (weights.second * weights.second);
  return of_weights * kernel.fourth / (kernel.second * kernel.second) / kurtosis;
}

}  // namespace solidnoise
