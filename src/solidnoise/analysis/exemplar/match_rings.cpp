#include "solidnoise/analysis/exemplar/match_rings.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace solidnoise {
namespace {

constexpr int kMostRounds = 60;

// The share of a component's power in each ring, by samples of its Gaussian.
std::vector<double> shares_of(double a, const SpectrumComponent& component, const FrequencyRings& rings) {
  constexpr int kSamples = 12;    // to each side of its centre, along an axis
  constexpr double kReach = 3.0;  // standard deviations
  Vec<2> deviation;
  for (int axis = 0; axis < 2; ++axis)
    deviation[axis] = std::sqrt(a * a / (4.0 * std::numbers::pi) + rings.blur[axis]);
  std::vector<double> shares(rings.count());
  double sum = 0.0;
  for (int i = -kSamples; i <= kSamples; ++i) {
    for (int k = -kSamples; k <= kSamples; ++k) {
      const Vec<2> at = kReach / kSamples * Vec<2>(i, k);
      const double weight = std::exp(-0.5 * (at.x * at.x + at.y * at.y));
      shares[rings.ring_of(Vec<2>(component.frequency) + deviation * at)] += weight;
      sum += weight;
    }
  }
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

void match_rings(GaborSpectrum& spectrum, const FrequencyRings& rings, std::size_t channel) {
  const std::vector<double>& targets = rings.variances[channel];
  std::vector<SpectrumComponent*> components;
  std::vector<std::vector<double>> shares;
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) {
      components.push_back(&component);
      shares.push_back(shares_of(band.a, component, rings));
    }
  }
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<double> powers(targets.size());
    for (std::size_t k = 0; k < components.size(); ++k) {
      for (std::size_t r = 0; r < powers.size(); ++r) powers[r] += components[k]->variance * shares[k][r];
    }
    for (std::size_t k = 0; k < components.size(); ++k) {
      double factor = 0.0;
      for (std::size_t r = 0; r < powers.size(); ++r) {
        if (powers[r] > 0.0) factor += shares[k][r] * targets[r] / powers[r];
      }
      components[k]->variance *= factor;
    }
  }
  // Rings without a component have left theirs.
  const double left = std::accumulate(targets.begin(), targets.end(), 0.0) / spectrum.variance();
  for (SpectrumComponent* component : components) component->variance *= left;
}

}  // namespace solidnoise
