#include "solidnoise/analysis/exemplar/solid_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

constexpr int kWidestWedges = 8;     // of directions, opposite ones taken as one
constexpr double kIsotropic = 0.2;   // differences of their power that are none
constexpr double kDeviations = 4.0;  // of a wedge's scatter, below which a difference may be chance
constexpr double kAttainable = 0.2;  // residual above which slices look different

// Radial means of a periodogram, per frequency step.
struct RadialMeans {
  std::vector<double> frequency;
  std::vector<double> density;
  std::vector<double> count;
};

RadialMeans radial_means(const PowerSpectrum<2>& periodogram) {
  const double step = std::max(periodogram.frequency_step(0), periodogram.frequency_step(1));
  const double highest = 0.5 / std::max(periodogram.step.x, periodogram.step.y);
  RadialMeans means;
  const auto bins = static_cast<std::size_t>(std::floor(highest / step + 0.5));
  means.frequency.assign(bins, 0.0);
  means.density.assign(bins, 0.0);
  means.count.assign(bins, 0.0);
  for (std::size_t i = 1; i < periodogram.density.size(); ++i) {
    const double f = glm::length(periodogram.frequency(i));
    const auto bin = static_cast<std::size_t>(std::floor(f / step + 0.5)) - 1;
    if (f < 0.5 * step || bin >= bins) continue;
    means.frequency[bin] += f;
    means.density[bin] += periodogram.density[i];
    means.count[bin] += 1.0;
  }
  for (std::size_t bin = 0; bin < bins; ++bin) {
    means.frequency[bin] /= means.count[bin];
    means.density[bin] /= means.count[bin];
  }
  return means;
}

struct Column {
  double a = 0.0;
  double frequency = 0.0;
};

std::vector<Column> make_columns(const PowerSpectrum<2>& periodogram) {
  const double sample = 0.5 * (periodogram.step.x + periodogram.step.y);
  const int fewest = std::min(periodogram.count.x, periodogram.count.y);
  const int last = std::max(2, static_cast<int>(std::floor(std::log2(fewest) + 1e-9)) - 1);
  std::vector<Column> columns;
  for (int b = 2; b <= last; ++b) {
    const double width = std::exp2(-b) / sample;
    const double a = width * std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2));
    for (int i = 0; 0.5 * width * i <= 0.5 / sample * 1.001; ++i) columns.push_back({a, 0.5 * width * i});
  }
  return columns;
}

// minimize |A v - y|^2 + nu sum v, v >= 0, by coordinate descent on the normal equations; A's columns have
// length 1.
Eigen::VectorXd descend(const Eigen::MatrixXd& gram, const Eigen::VectorXd& target, double nu,
                        Eigen::VectorXd v, Progress* progress) {
  constexpr int kSweeps = 20000;
  constexpr double kStill = 1e-10;
  Eigen::VectorXd product = gram * v;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    throw_if_cancelled(progress);
    double largest = 0.0;
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      const double next = std::max(0.0, v[j] + (target[j] - 0.5 * nu - product[j]) / gram(j, j));
      const double change = next - v[j];
      if (change == 0.0) continue;
      product += change * gram.col(j);
      v[j] = next;
      largest = std::max(largest, std::abs(change));
    }
    if (largest < kStill * std::max(1e-30, v.maxCoeff())) break;
  }
  return v;
}

// The largest relative difference of a wedge's power from the mean that its scatter does not explain.
double anisotropy_of(const PowerSpectrum<2>& periodogram) {
  std::array<double, kWidestWedges> power{};
  std::array<double, kWidestWedges> squares{};
  const double lowest = 1.5 * std::max(periodogram.frequency_step(0), periodogram.frequency_step(1));
  const double highest = 0.5 / std::max(periodogram.step.x, periodogram.step.y);
  for (std::size_t i = 0; i < periodogram.density.size(); ++i) {
    const Vec<2> f = periodogram.frequency(i);
    if (glm::length(f) < lowest || glm::length(f) > highest) continue;
    double turn = std::atan2(f.y, f.x) / std::numbers::pi;
    turn -= std::floor(turn);
    const auto wedge =
        std::min<std::size_t>(kWidestWedges - 1, static_cast<std::size_t>(turn * kWidestWedges));
    power[wedge] += periodogram.density[i];
    squares[wedge] += periodogram.density[i] * periodogram.density[i];
  }
  double mean = 0.0;
  for (const double value : power) mean += value / kWidestWedges;
  double largest = 0.0;
  for (std::size_t w = 0; w < kWidestWedges; ++w) {
    const double difference = std::abs(power[w] / mean - 1.0);
    // Values of a periodogram scatter by themselves, f and -f alike; their squares are twice too large.
    const double scatter = std::sqrt(squares[w] / periodogram.independent_blocks) / mean;
    if (difference > kDeviations * scatter) largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace

double slice_density(double f, double frequency, double a) {
  // The trapezoidal rule converges like the transform of a Gaussian: 4 steps per a are plenty.
  const double sharpness = 2.0 * std::numbers::pi / (a * a);
  const double step = 0.125 * a;
  const int steps = static_cast<int>(std::ceil((frequency + 4.0 * a) / step));
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = step * i;
    const double rho = std::sqrt(f * f + t * t);
    const double value = std::exp(-sharpness * (rho - frequency) * (rho - frequency)) *
                         mean_exponential_scaled(3, 2.0 * sharpness * rho * frequency);
    sum += i == 0 ? value : 2.0 * value;
  }
  return sum * step * std::pow(std::numbers::sqrt2 / a, 3.0);
}

SolidFit fit_solid_spectrum(const PowerSpectrum<2>& periodogram, double variance, double kappa,
                            Progress* progress) {
  require_in_range("kappa", kappa, 1e-6, 1.0);
  require_positive("variance", variance);
  const RadialMeans means = radial_means(periodogram);
  const std::vector<Column> columns = make_columns(periodogram);
  const auto rows = static_cast<Eigen::Index>(means.density.size());
  const auto count = static_cast<Eigen::Index>(columns.size());

  // Weighted by the number of frequencies in each mean; columns of length 1.
  Eigen::MatrixXd matrix(rows, count);
  Eigen::VectorXd target(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    throw_if_cancelled(progress);
    const auto bin = static_cast<std::size_t>(i);
    const double weight = std::sqrt(means.count[bin]);
    target[i] = weight * means.density[bin];
    for (Eigen::Index j = 0; j < count; ++j) {
      const Column& column = columns[static_cast<std::size_t>(j)];
      matrix(i, j) = weight * slice_density(means.frequency[bin], column.frequency, column.a);
    }
  }
  const double length = target.norm();
  if (!(length > 0.0)) throw std::invalid_argument("the spectrum has no power");
  target /= length;
  const Eigen::VectorXd lengths = matrix.colwise().norm();
  for (Eigen::Index j = 0; j < count; ++j) matrix.col(j) /= lengths[j];

  const Eigen::MatrixXd gram = matrix.transpose() * matrix;
  const Eigen::VectorXd correlation = matrix.transpose() * target;
  const double nu_max = 2.0 * correlation.maxCoeff();
  Eigen::VectorXd v = Eigen::VectorXd::Zero(count);
  // Half the penalty at a time.
  std::vector<double> levels;
  for (double level = 0.5; level > 1.001 * kappa; level *= 0.5) levels.push_back(level);
  levels.push_back(kappa);
  std::uint64_t done = 0;
  for (const double level : levels) {
    v = descend(gram, correlation, level * nu_max, v, progress);
    if (progress != nullptr) progress->advance(++done, levels.size() + 1);
  }

  SolidFit fit;
  fit.residual = (matrix * v - target).norm();
  fit.attainability = (matrix * descend(gram, correlation, 0.0, v, progress) - target).norm();
  fit.anisotropy = anisotropy_of(periodogram);
  fit.spectrum.dimensions = 3;
  fit.spectrum.isotropic = true;
  for (Eigen::Index j = 0; j < count; ++j) {
    if (!(v[j] > 0.0)) continue;
    const Column& column = columns[static_cast<std::size_t>(j)];
    if (fit.spectrum.bands.empty() || fit.spectrum.bands.back().a != column.a) {
      fit.spectrum.bands.push_back({column.a, {}});
    }
    fit.spectrum.bands.back().components.push_back(
        {Vec<3>(column.frequency, 0.0, 0.0), v[j] / lengths[j], 0});
    ++fit.components;
  }
  const double total = fit.spectrum.variance();
  for (SpectrumBand& band : fit.spectrum.bands) {
    for (SpectrumComponent& component : band.components) component.variance *= variance / total;
  }

  if (fit.anisotropy > kIsotropic) {
    fit.warnings.push_back(
        fmt::format("the exemplar is not isotropic: a direction has {:.0f} % more or less "
                    "power than the mean; solid noise has the mean in all directions",
                    100.0 * fit.anisotropy));
  }
  if (fit.attainability > kAttainable) {
    fit.warnings.push_back(
        fmt::format("no isotropic solid noise has slices like the exemplar: they differ by "
                    "{:.2g} at least, mostly by low frequencies; use noise on the surface",
                    fit.attainability));
  }
  return fit;
}

SolidExemplarFit fit_solid_exemplar(std::span<const Exemplar<2>> exemplars, const ExemplarFitOptions& options,
                                    Progress* progress) {
  options.validate();
  if (options.squares) {
    ExemplarFitOptions of_roots = options;
    of_roots.squares = false;
    SolidExemplarFit fit = fit_solid_exemplar(square_roots(exemplars), of_roots, progress);
    square_colors(fit.model, sample_moments(exemplars));
    return fit;
  }
  const CrossSpectra<2> spectra = cross_spectra(exemplars, options.patch, progress);
  const ExemplarChannels channels = exemplar_channels(spectra, options.axes);
  SolidExemplarFit result;
  result.model.raw_values = options.raw_values;
  result.count = spectra.count;
  result.patches = spectra.patches;
  result.dependence = channels.dependence;
  result.model.mean = channels.mean;
  result.model.axes = channels.axes;
  const auto count = static_cast<double>(channels.axes.size());
  for (std::size_t k = 0; k < channels.axes.size(); ++k) {
    throw_if_cancelled(progress);
    PartialProgress part(progress, static_cast<double>(k) / count, static_cast<double>(k + 1) / count);
    SolidFit& fit = result.channels.emplace_back();
    if (channels.is_empty(k)) {
      fit.spectrum = channels.empty_spectrum(3, spectra.step.x);
      fit.spectrum.isotropic = true;
    } else {
      const PowerSpectrum<2> periodogram = spectra.spectrum(channels.directions[k]);
      fit = fit_solid_spectrum(periodogram, channels.variances[k], options.spectrum.kappa, &part);
    }
    result.model.channels.push_back(fit.spectrum);
  }
  result.model.validate();
  return result;
}

}  // namespace solidnoise
