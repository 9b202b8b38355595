#include "solidnoise/noise/gabor/spectrum_bands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "solidnoise/noise/convolution/impulse_process.h"

namespace solidnoise {

namespace {

// The fewest impulses, in the bands' supports together, that look Gaussian; of kernels of one amplitude.
double fewest_impulses(std::span<const BandShare> bands, ImpulseSpread spread) {
  // At amplitude 1: impulses, and excess kurtosis or how far it is from 0 given the place.
  double count = 0.0;
  double kurtosis = 0.0;
  for (const auto& [variance, support, choice] : bands) {
    const KernelMoments& moments = choice.moments;
    const double density = variance / moments.second;
    count += density * support;
    if (spread == ImpulseSpread::poisson) {
      kurtosis += variance * moments.fourth / moments.second;
    } else {
      kurtosis += density * std::pow(moments.second, 2) *
                  kurtosis_given_place(1.0, choice.moments, *choice.averages, choice.balanced());
    }
  }
  const double wanted = spread == ImpulseSpread::poisson ? kExampleKurtosis : kExamplePlaceKurtosis;
  return std::ceil(count * kurtosis / wanted);
}

}  // namespace

ImpulseBudget share_impulses(std::span<const BandShare> bands, double impulses, ImpulseSpread spread) {
  double count = 0.0;  // at amplitude 1
  for (const BandShare& band : bands) count += band.variance / band.choice.moments.second * band.support;
  const double wanted = impulses > 0.0 ? impulses : fewest_impulses(bands, spread);
  ImpulseBudget budget;
  for (const BandShare& band : bands) {
    const double shared = wanted / count * band.variance / band.choice.moments.second;
    const double least = spread == ImpulseSpread::poisson ? kLeastImpulses / band.support
                                                          : band.choice.density_of(band.choice.balanced());
    const double density = std::max(shared, least);
    budget.densities.push_back(density);
    budget.impulses += density * band.support;
  }
  return budget;
}

double kurtosis_given_place(std::span<const BandShare> bands, std::span<const double> densities) {
  double sum = 0.0;
  for (std::size_t b = 0; b < densities.size(); ++b) {
    const auto& [variance, support, choice] = bands[b];
    sum +=
        variance * variance *
        kurtosis_given_place(densities[b], choice.moments, *choice.averages, choice.of_density(densities[b]));
  }
  return sum;
}

double variance_of(const SpectrumBand& band) {
  double sum = 0.0;
  for (const SpectrumComponent& component : band.components) sum += component.variance;
  return sum;
}

double rms_frequency(const SpectrumBand& band) {
  double sum = 0.0;
  for (const SpectrumComponent& component : band.components) {
    sum += component.variance * glm::dot(component.frequency, component.frequency);
  }
  return std::sqrt(sum / variance_of(band));
}

GaborSpectrum of_unit_variance(const GaborSpectrum& spectrum) {
  GaborSpectrum result = spectrum;
  const double variance = spectrum.variance();
  std::erase_if(result.bands, [](const SpectrumBand& band) { return variance_of(band) == 0.0; });
  for (SpectrumBand& band : result.bands) {
    for (SpectrumComponent& component : band.components) component.variance /= variance;
  }
  return result;
}

Noise<2>::Band frequency_interval(const GaborSpectrum& spectrum) {
  Noise<2>::Band interval{HUGE_VAL, 0.0};
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& component : band.components) {
      if (component.variance == 0.0) continue;
      const double frequency = glm::length(component.frequency);
      interval.lower = std::min(interval.lower, std::max(0.0, frequency - band.a));
      interval.upper = std::max(interval.upper, frequency + band.a);
    }
  }
  return interval;
}

namespace {

// Where a component stands in the order of a band's: by its angle around the last axis, a wave and its
// opposite being the same, or by its frequency.
double place_of(const Vec<3>& frequency, bool isotropic) {
  if (isotropic) return glm::length(frequency);
  const double angle = std::atan2(frequency.y, frequency.x);
  return angle < 0.0 ? angle + std::numbers::pi : angle;
}

}  // namespace

template <int Dim>
ComponentDraw<Dim>::ComponentDraw(const SpectrumBand& band, bool isotropic) {
  std::vector<SpectrumComponent> components = band.components;
  std::stable_sort(components.begin(), components.end(), [&](const auto& one, const auto& other) {
    return place_of(one.frequency, isotropic) < place_of(other.frequency, isotropic);
  });
  std::vector<double> variances;
  std::vector<Vec<Dim>> frequencies;
  for (const SpectrumComponent& component : components) {
    variances.push_back(component.variance);
    frequencies.emplace_back(component.frequency);
  }
  components_ = std::make_shared<CumulativeTable>(variances);
  frequencies_ = std::make_shared<std::vector<Vec<Dim>>>(std::move(frequencies));
  Vec<Dim> axis(0.0);
  axis[0] = 1.0;
  if (isotropic) directions_.emplace(axis, 0.0);
}

template <int Dim>
Vec<Dim> ComponentDraw<Dim>::operator()(double share, RandomStream& stream) const {
  // Finer than the share's steps: a component may be as weak as one of them.
  const double fine = static_cast<double>(kShareMask + 1);
  const Vec<Dim>& frequency = (*frequencies_)[components_->draw(share + stream.next_unit() / fine)];
  return directions_ ? glm::length(frequency) * directions_->draw(stream.next_unit(), stream) : frequency;
}

template class ComponentDraw<2>;
template class ComponentDraw<3>;

}  // namespace solidnoise
