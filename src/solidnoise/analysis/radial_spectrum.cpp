#include "solidnoise/analysis/radial_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// The bins of a spectrum's frequencies: per element the number of its bin, or -1.
struct Binning {
  std::vector<int> bin;
  std::vector<RadialBin> bins;  // without powers
};

template <int Dim>
Binning bin_frequencies(const PowerSpectrum<Dim>& spectrum, double width) {
  double nyquist = std::numeric_limits<double>::infinity();
  double largest_step = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    nyquist = std::min(nyquist, 0.5 / spectrum.step[axis]);
    largest_step = std::max(largest_step, spectrum.frequency_step(axis));
  }
  require_at_least("radial bin width", width, 0.0, "cycles per unit");
  if (width == 0.0) width = 2.0 * largest_step;

  const std::size_t candidates = static_cast<std::size_t>(std::ceil(nyquist / width));
  std::vector<RadialBin> all(candidates);
  std::vector<int> candidate(spectrum.density.size(), -1);
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<Dim> frequency = spectrum.frequency(i);
    double squared = 0.0;
    for (int axis = 0; axis < Dim; ++axis) squared += frequency[axis] * frequency[axis];
    const double f = std::sqrt(squared);
    const std::size_t at = static_cast<std::size_t>(f / width);
    if (f >= nyquist || at >= candidates) continue;
    candidate[i] = static_cast<int>(at);
    all[at].frequency += f;
    ++all[at].count;
  }

  Binning result;
  std::vector<int> number(candidates, -1);
  for (std::size_t at = 0; at < candidates; ++at) {
    RadialBin bin = all[at];
    if (bin.count == 0) continue;
    bin.lower = static_cast<double>(at) * width;
    bin.upper = std::min(bin.lower + width, nyquist);
    bin.frequency /= static_cast<double>(bin.count);
    number[at] = static_cast<int>(result.bins.size());
    result.bins.push_back(bin);
  }
  for (int& at : candidate) at = at < 0 ? -1 : number[static_cast<std::size_t>(at)];
  result.bin = std::move(candidate);
  return result;
}

std::vector<double> bin_means(const Binning& binning, const std::vector<double>& density) {
  std::vector<double> means(binning.bins.size(), 0.0);
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (binning.bin[i] >= 0) means[static_cast<std::size_t>(binning.bin[i])] += density[i];
  }
  for (std::size_t b = 0; b < means.size(); ++b) means[b] /= static_cast<double>(binning.bins[b].count);
  return means;
}

// One neighbour of a frequency that correlates with it, per axis and together.
template <int Dim>
struct Neighbour {
  glm::vec<Dim, int> offset;
  double correlation;  // of the two periodogram values, for a spectrum that varies little between them
};

// A Hann window's spectrum at -2 to 2 frequency steps is 1/6, -2/3, 1, -2/3, 1/6 of its energy (the transform
// of sin^4) and 0 at all others; the correlation of two periodogram values is the square.
template <int Dim>
std::vector<Neighbour<Dim>> neighbours(Window window, const glm::vec<Dim, int>& count) {
  constexpr std::array<double, 3> kHann{1.0, 4.0 / 9.0, 1.0 / 36.0};
  const int reach = window == Window::hann ? 2 : 0;
  std::vector<Neighbour<Dim>> result;
  glm::vec<Dim, int> offset(-reach);
  while (true) {
    double correlation = 1.0;
    bool distinct = true;
    for (int axis = 0; axis < Dim; ++axis) {
      correlation *= kHann[static_cast<std::size_t>(std::abs(offset[axis]))];
      distinct = distinct && 2 * std::abs(offset[axis]) < count[axis];
    }
    if (distinct) result.push_back({offset, correlation});
    int axis = Dim - 1;
    while (axis >= 0 && ++offset[axis] > reach) {
      offset[axis] = -reach;
      --axis;
    }
    if (axis < 0) return result;
  }
}

// The covariance of the bins' means, for a Gaussian field whose mean periodogram is `mean`:
//   cov(b, c) = 2 / (B n_b n_c) * sum over j in b, k in c of mean_j mean_k correlation(j - k);
// the factor 2 is there because the values at f and -f are the same, and B is the number of blocks.
template <int Dim>
Eigen::MatrixXd bin_covariance(const Binning& binning, const PowerSpectrum<Dim>& spectrum,
                               const std::vector<double>& mean) {
  const Eigen::Index bins = static_cast<Eigen::Index>(binning.bins.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(bins, bins);
  const ArrayShape<Dim> shape{spectrum.count};
  const std::vector<Neighbour<Dim>> near = neighbours(spectrum.window, spectrum.count);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (binning.bin[i] < 0) continue;
    const glm::vec<Dim, int> at = shape.position(i);
    for (const Neighbour<Dim>& neighbour : near) {
      glm::vec<Dim, int> beside = at + neighbour.offset;
      for (int axis = 0; axis < Dim; ++axis) {
        const int n = spectrum.count[axis];
        beside[axis] =
            beside[axis] < 0 ? beside[axis] + n : (beside[axis] >= n ? beside[axis] - n : beside[axis]);
      }
      const std::size_t other = shape.index(beside);
      if (binning.bin[other] < 0) continue;
      covariance(binning.bin[i], binning.bin[other]) += mean[i] * mean[other] * neighbour.correlation;
    }
  }
  for (Eigen::Index b = 0; b < bins; ++b) {
    for (Eigen::Index c = 0; c < bins; ++c) {
      const double pairs = static_cast<double>(binning.bins[static_cast<std::size_t>(b)].count) *
                           static_cast<double>(binning.bins[static_cast<std::size_t>(c)].count);
      covariance(b, c) *= 2.0 / (spectrum.independent_blocks * pairs);
    }
  }
  return covariance;
}

// d^T C^-1 d over the counted bins.
double chi_square(const std::vector<ComparedBin>& bins, const Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Index> counted;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (bins[b].counted) counted.push_back(static_cast<Eigen::Index>(b));
  }
  if (counted.empty()) return 0.0;
  Eigen::VectorXd difference(static_cast<Eigen::Index>(counted.size()));
  for (Eigen::Index i = 0; i < difference.size(); ++i) {
    const ComparedBin& bin = bins[static_cast<std::size_t>(counted[static_cast<std::size_t>(i)])];
    difference(i) = bin.measured.power - bin.expected;
  }
  const Eigen::MatrixXd part = covariance(counted, counted);
  return difference.dot(part.ldlt().solve(difference));
}

}  // namespace

template <int Dim>
std::vector<RadialBin> radial_average(const PowerSpectrum<Dim>& spectrum, double width) {
  Binning binning = bin_frequencies(spectrum, width);
  const std::vector<double> means = bin_means(binning, spectrum.density);
  // Single periodogram values scatter as much as their mean: the bin's mean stands for theirs.
  std::vector<double> smooth(spectrum.density.size(), 0.0);
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    if (binning.bin[i] >= 0) smooth[i] = means[static_cast<std::size_t>(binning.bin[i])];
  }
  const Eigen::MatrixXd covariance = bin_covariance(binning, spectrum, smooth);
  for (std::size_t b = 0; b < means.size(); ++b) {
    const Eigen::Index at = static_cast<Eigen::Index>(b);
    binning.bins[b].power = means[b];
    binning.bins[b].standard_error = std::sqrt(covariance(at, at));
  }
  return binning.bins;
}

template <int Dim>
SpectrumComparison compare_spectra(const PowerSpectrum<Dim>& measured, const PowerSpectrum<Dim>& expected,
                                   const ComparisonOptions& options) {
  if (measured.count != expected.count || measured.step != expected.step ||
      measured.window != expected.window) {
    throw std::invalid_argument("spectra of different blocks, steps or windows cannot be compared");
  }
  require_at_least("impulse density", options.impulse_density, 0.0, "impulses per unit^Dim");
  require_in_range("kernel error", options.kernel_error, 0.0, 1.0);

  const Binning binning = bin_frequencies(measured, options.width);
  const std::vector<double> powers = bin_means(binning, measured.density);
  const std::vector<double> means = bin_means(binning, expected.density);
  Eigen::MatrixXd covariance = bin_covariance(binning, measured, expected.density);
  if (options.impulse_density > 0.0) {
    const double relative_variance = 1.0 / (options.impulse_density * measured.effective_volume);
    const Eigen::Map<const Eigen::VectorXd> mean(means.data(), static_cast<Eigen::Index>(means.size()));
    covariance += relative_variance * mean * mean.transpose();
  }

  const double highest = means.empty() ? 0.0 : *std::max_element(means.begin(), means.end());
  for (std::size_t b = 0; b < means.size(); ++b) {
    const double e = options.kernel_error;
    const double tolerance = e * std::sqrt(means[b] * highest) + e * e * highest;
    const Eigen::Index at = static_cast<Eigen::Index>(b);
    covariance(at, at) += tolerance * tolerance;
  }

  SpectrumComparison result;
  for (std::size_t b = 0; b < means.size(); ++b) {
    const Eigen::Index at = static_cast<Eigen::Index>(b);
    ComparedBin bin{binning.bins[b], means[b], false};
    bin.measured.power = powers[b];
    bin.measured.standard_error = std::sqrt(covariance(at, at));
    bin.counted = bin.expected > options.floor * highest &&
                  bin.measured.standard_error <= options.largest_error * bin.expected;
    if (bin.counted) ++result.degrees_of_freedom;
    result.bins.push_back(bin);
  }
  result.chi_square = chi_square(result.bins, covariance);
  result.significance = chi_square_significance(result.chi_square, result.degrees_of_freedom);
  return result;
}

double chi_square_significance(double x, int k) {
  if (k <= 0) return 1.0;
  const double spread = 2.0 / (9.0 * k);
  const double z = (std::cbrt(x / k) - (1.0 - spread)) / std::sqrt(spread);
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

template std::vector<RadialBin> radial_average<1>(const PowerSpectrum<1>&, double);
template std::vector<RadialBin> radial_average<2>(const PowerSpectrum<2>&, double);
template std::vector<RadialBin> radial_average<3>(const PowerSpectrum<3>&, double);
template SpectrumComparison compare_spectra<1>(const PowerSpectrum<1>&, const PowerSpectrum<1>&,
                                               const ComparisonOptions&);
template SpectrumComparison compare_spectra<2>(const PowerSpectrum<2>&, const PowerSpectrum<2>&,
                                               const ComparisonOptions&);
template SpectrumComparison compare_spectra<3>(const PowerSpectrum<3>&, const PowerSpectrum<3>&,
                                               const ComparisonOptions&);

}  // namespace solidnoise
