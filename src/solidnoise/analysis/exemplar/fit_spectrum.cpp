#include "solidnoise/analysis/exemplar/fit_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/analysis/exemplar/fill_spectrum.h"
#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// Components that hold less than this of the variance between them are dropped: traces that the solver has
// not yet brought to 0.
constexpr double kTraces = 1e-3;

template <int Dim>
FrequencyGrid grid_of(const PowerSpectrum<Dim>& periodogram) {
  FrequencyGrid grid;
  grid.dimensions = Dim;
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t stored = Dim == 2 && axis == 1 ? 2 : static_cast<std::size_t>(axis);
    grid.count[stored] = periodogram.count[axis];
    grid.step[stored] = periodogram.frequency_step(axis);
  }
  return grid;
}

int largest_divisor(int number, double most) {
  int result = 1;
  for (int i = 2; i <= number && i <= most; ++i) {
    if (number % i == 0) result = i;
  }
  return result;
}

template <int Dim>
std::vector<AtomBand> make_bands(const PowerSpectrum<Dim>& periodogram, const FrequencyGrid& grid,
                                 bool narrowest) {
  int fewest = periodogram.count[0];
  double sample = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    fewest = std::min(fewest, periodogram.count[axis]);
    sample += periodogram.step[axis] / Dim;
  }
  // In bands of one frequency's width if that is a power of 2.
  const int last = std::max(2, static_cast<int>(std::floor(std::log2(fewest) + 1e-9)) - (narrowest ? 0 : 1));
  std::vector<AtomBand> bands;
  for (int b = 2; b <= last; ++b) {
    const double width = std::exp2(-b) / sample;  // full, at half of the maximum
    AtomBand& band = bands.emplace_back();
    band.a = width * std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (grid.count[axis] == 1) continue;
      band.spacing[axis] = largest_divisor(grid.count[axis], 0.5 * width / grid.step[axis] + 1e-9);
    }
  }
  return bands;
}

// The components of a fit, with variances in the periodogram's unit.
GaborSpectrum components_of(const GaussianAtoms& atoms, const GaussianAtoms::Coefficients& x, double cell) {
  const FrequencyGrid& grid = atoms.grid();
  GaborSpectrum result;
  result.dimensions = grid.dimensions;
  std::vector<double> variances;
  for (std::size_t band = 0; band < x.size(); ++band) {
    SpectrumBand& components = result.bands.emplace_back();
    components.a = atoms.bands()[band].a;
    for (std::size_t i = 0; i < x[band].size(); ++i) {
      if (!(x[band][i] > 0.0) || !atoms.is_first_copy(band, i)) continue;
      SpectrumComponent& component = components.components.emplace_back();
      const Counts3 index = atoms.frequency_index(band, i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (grid.count[axis] == 1) continue;
        component.frequency[grid.dimension_of(static_cast<int>(axis))] = index[axis] * grid.step[axis];
      }
      component.variance = x[band][i] * atoms.pair_sum(band) * cell;
      variances.push_back(component.variance);
    }
  }

  // Drop the traces, and bands that are left empty.
  std::sort(variances.begin(), variances.end());
  double total = 0.0;
  for (const double variance : variances) total += variance;
  double dropped = 0.0;
  double threshold = 0.0;
  for (const double variance : variances) {
    dropped += variance;
    if (dropped > kTraces * total) break;
    threshold = variance;
  }
  for (SpectrumBand& band : result.bands) {
    std::erase_if(band.components, [&](const SpectrumComponent& c) { return c.variance <= threshold; });
  }
  std::erase_if(result.bands, [](const SpectrumBand& band) { return band.components.empty(); });
  return result;
}

// Makes a spectrum's variance that of the samples. Of what the periodogram has, each component takes its
// share; what it has not, the trend from border to border that its periodic component leaves out, is of the
// lowest frequencies, if there are any.
template <int Dim>
void scale_to(double variance, const PowerSpectrum<Dim>& periodogram, GaborSpectrum& spectrum) {
  constexpr double kLowest = 4.0;  // steps of the periodogram
  double step = 0.0;
  for (int axis = 0; axis < Dim; ++axis) step = std::max(step, periodogram.frequency_step(axis));
  const auto is_low = [&](const SpectrumComponent& component) {
    return glm::length(component.frequency) < kLowest * step;
  };
  double low = 0.0;
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& component : band.components)
      low += is_low(component) ? component.variance : 0.0;
  }
  const double total = spectrum.variance();
  double others = periodogram.variance() / total;
  double lowest = low > 0.0 ? others + (variance - periodogram.variance()) / low : 0.0;
  if (!(others > 0.0) || lowest < 0.5 * others) others = lowest = variance / total;
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components)
      component.variance *= is_low(component) ? lowest : others;
  }
}

}  // namespace

SpectrumFitOptions SpectrumFitOptions::of_paper() {
  SpectrumFitOptions options;
  options.narrowest_band = true;
  options.fill = false;
  return options;
}

void SpectrumFitOptions::validate() const {
  SparseFitOptions{kappa, gap_tolerance, iterations_per_level}.validate();
}

template <int Dim>
SpectrumFit fit_spectrum(const PowerSpectrum<Dim>& periodogram, double variance,
                         const SpectrumFitOptions& options, Progress* progress) {
  options.validate();
  require_positive("variance", variance);
  const FrequencyGrid grid = grid_of(periodogram);
  const GaussianAtoms atoms(grid, make_bands(periodogram, grid, options.narrowest_band));

  // In units in which the largest density is 1.
  std::vector<double> target = periodogram.density;
  const double scale = *std::max_element(target.begin(), target.end());
  if (!(scale > 0.0) || !std::isfinite(scale)) throw std::invalid_argument("the spectrum has no power");
  for (double& value : target) value /= scale;
  const std::vector<double> lags = atoms.lags_of(target);

  SparseFit fit =
      fit_sparse(atoms, lags, {options.kappa, options.gap_tolerance, options.iterations_per_level}, progress);
  SpectrumFit result;
  result.kappa = fit.kappa;
  result.gap = fit.gap / fit.objective;
  result.iterations = fit.iterations;
  result.interrupted = fit.interrupted;
  result.residual = fit.residual;
  result.spectrum = components_of(atoms, fit.x, scale * periodogram.cell());
  if constexpr (Dim == 2) {
    if (options.fill) fill_spectrum(result.spectrum, periodogram);
  }
  const double total = result.spectrum.variance();
  result.kept_variance = total / variance;
  for (const SpectrumBand& band : result.spectrum.bands) {
    result.components += static_cast<int>(band.components.size());
  }
  scale_to(variance, periodogram, result.spectrum);
  result.sparseness = result.components / static_cast<double>(grid.size());
  return result;
}

template SpectrumFit fit_spectrum<2>(const PowerSpectrum<2>&, double, const SpectrumFitOptions&, Progress*);
template SpectrumFit fit_spectrum<3>(const PowerSpectrum<3>&, double, const SpectrumFitOptions&, Progress*);

}  // namespace solidnoise
