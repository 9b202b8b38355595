#include "papers/literal_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/analysis/exemplar/gaussian_atoms.h"

namespace solidnoise::papers {
namespace {

using Coefficients = GaussianAtoms::Coefficients;

GaussianAtoms make_atoms(const PowerSpectrum<2>& periodogram) {
  const int side = periodogram.count.x;
  FrequencyGrid grid;
  grid.count = {side, 1, side};
  grid.step = {periodogram.frequency_step(0), 1.0, periodogram.frequency_step(1)};
  std::vector<AtomBand> bands;
  for (int frequencies = side / 4; frequencies >= 1; frequencies /= 2) {
    AtomBand& band = bands.emplace_back();
    band.a = frequencies * grid.step[0] * std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2));
    band.spacing = {std::max(1, frequencies / 2), 1, std::max(1, frequencies / 2)};
  }
  return {grid, bands};
}

// The penalty of a coefficient of each band, the widest band's being 1: an atom of squared magnitude 1 has
// the length a^-4 a, up to a factor.
std::vector<double> penalties(const GaussianAtoms& atoms, Penalty penalty) {
  std::vector<double> result;
  for (const AtomBand& band : atoms.bands()) {
    const double ratio = band.a / atoms.bands().front().a;
    result.push_back(penalty == Penalty::lengths ? 1.0 : ratio * ratio * ratio);
  }
  return result;
}

double nu_at_zero(const GaussianAtoms& atoms, const std::vector<double>& target,
                  const std::vector<double>& penalty) {
  Coefficients correlation = atoms.zeros();
  atoms.correlate(target, correlation);
  double highest = 0.0;
  for (std::size_t band = 0; band < correlation.size(); ++band) {
    for (const double value : correlation[band]) highest = std::max(highest, 2.0 * value / penalty[band]);
  }
  return highest;
}

}  // namespace

BandCounts fit_bands(const PowerSpectrum<2>& periodogram, double kappa, Penalty penalty, int iterations) {
  const GaussianAtoms atoms = make_atoms(periodogram);
  const std::vector<double> costs = penalties(atoms, penalty);
  std::vector<double> target = periodogram.density;
  const double scale = *std::max_element(target.begin(), target.end());
  for (double& value : target) value /= scale;
  target = atoms.lags_of(target);
  const double nu_max = nu_at_zero(atoms, target, costs);
  const double step = 1.0 / (2.0 * atoms.norm_squared());

  Coefficients x = atoms.zeros();
  Coefficients pushed = x;
  Coefficients gradient = x;
  std::vector<double> lags;
  for (double level = 0.5; level > 0.999 * kappa; level *= 0.5) {
    double momentum = 1.0;
    pushed = x;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      atoms.synthesize(pushed, lags);
      for (std::size_t i = 0; i < lags.size(); ++i) lags[i] -= target[i];
      atoms.correlate(lags, gradient);
      const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
      for (std::size_t band = 0; band < x.size(); ++band) {
        const double nu = level * nu_max * costs[band];
        for (std::size_t i = 0; i < x[band].size(); ++i) {
          const double value = std::max(0.0, pushed[band][i] - step * (2.0 * gradient[band][i] + nu));
          pushed[band][i] = value + (momentum - 1.0) / next * (value - x[band][i]);
          x[band][i] = value;
        }
      }
      momentum = next;
    }
  }

  BandCounts result;
  double largest = 0.0;
  for (const std::vector<double>& values : x) {
    for (const double value : values) largest = std::max(largest, value);
  }
  for (std::size_t band = 0; band < x.size(); ++band) {
    int count = 0;
    for (std::size_t i = 0; i < x[band].size(); ++i) {
      if (x[band][i] > 1e-3 * largest && atoms.is_first_copy(band, i)) ++count;
    }
    result.components.push_back(count);
  }
  atoms.synthesize(x, lags);
  for (std::size_t i = 0; i < lags.size(); ++i) lags[i] -= target[i];
  result.residual = std::sqrt(atoms.dot(lags, lags) / atoms.dot(target, target));
  return result;
}

}  // namespace solidnoise::papers
