#include "solidnoise/analysis/exemplar/gaussian_atoms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

// Responses below this share of the largest one are left out: they change nothing in double precision.
constexpr double kNegligibleResponse = 1e-17;
constexpr int kTorusImages = 3;  // of the Gaussian on the torus, to each side

std::size_t to_size(int value) {
  return static_cast<std::size_t>(value);
}

// exp(-2 pi f^2 / a^2) at the frequencies of one axis, with its images.
std::vector<double> sampled_gaussian(double a, double step, int count) {
  std::vector<double> result(to_size(count), 0.0);
  for (int k = 0; k < count; ++k) {
    for (int image = -kTorusImages; image <= kTorusImages; ++image) {
      const double f = step * (k + image * count);
      result[to_size(k)] += std::exp(-2.0 * std::numbers::pi * f * f / (a * a));
    }
  }
  return result;
}

// The transform of an even real row: sum_k h_k cos(2 pi k t / n).
std::vector<double> cosine_transform(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> cosines(n);
  for (std::size_t i = 0; i < n; ++i) {
    cosines[i] = std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  }
  std::vector<double> result(n, 0.0);
  for (std::size_t t = 0; t < n; ++t) {
    for (std::size_t k = 0; k < n; ++k) result[t] += values[k] * cosines[k * t % n];
  }
  return result;
}

// Position of an element of an array with these counts.
Counts3 position_of(std::size_t index, const Counts3& counts) {
  Counts3 result{};
  for (std::size_t axis = 3; axis-- > 0;) {
    result[axis] = static_cast<int>(index % to_size(counts[axis]));
    index /= to_size(counts[axis]);
  }
  return result;
}

int mirrored(int index, int count) {
  return index == 0 ? 0 : count - index;
}

}  // namespace

GaussianAtoms::GaussianAtoms(const FrequencyGrid& grid, std::vector<AtomBand> bands)
    : grid_(grid), bands_(std::move(bands)), transform_(grid.count) {
  for (std::size_t band = 0; band < bands_.size(); ++band) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int spacing = bands_[band].spacing[axis];
      if (spacing < 1 || grid_.count[axis] % spacing != 0) {
        throw std::invalid_argument(
            fmt::format("the spacing {} does not divide the count {}", spacing, grid_.count[axis]));
      }
    }
    const Counts3 counts = band_counts(band);
    band_transforms_.emplace_back(counts);

    // The response, scaled to pairs of length 1.
    std::array<Axis, 3>& axes = axes_.emplace_back();
    double energy = 1.0;
    double sum = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool absent = grid_.dimensions == 2 && axis == 1;
      const std::vector<double> h =
          absent ? std::vector<double>{1.0}
                 : sampled_gaussian(bands_[band].a, grid_.step[axis], grid_.count[axis]);
      double axis_energy = 0.0;
      double axis_sum = 0.0;
      for (const double value : h) axis_energy += value * value;
      for (const double value : h) axis_sum += value;
      energy *= axis_energy;
      sum *= axis_sum;
      axes[axis].response = cosine_transform(h);
      for (std::size_t t = 0; t < h.size(); ++t) {
        const int folded = static_cast<int>(t) % counts[axis];
        axes[axis].folded.push_back(folded);
        axes[axis].mirrored.push_back(mirrored(folded, counts[axis]));
        if (std::abs(axes[axis].response[t]) > kNegligibleResponse * axis_sum) {
          axes[axis].used.push_back(static_cast<int>(t));
        }
      }
    }
    const double scale = 1.0 / std::sqrt(2.0 * energy);
    for (double& value : axes[0].response) value *= scale;
    pair_sums_.push_back(2.0 * scale * sum);

    // Coefficients that are stored twice, or are their own mirror image.
    const Counts3 stored = half_counts(counts, HalfAxis::last);
    std::vector<double>& weights = weights_.emplace_back(element_count(stored), 1.0);
    std::vector<std::size_t>& own = own_mirrors_.emplace_back();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Counts3 at = position_of(i, stored);
      if (at[2] != mirrored(at[2], counts[2])) continue;
      if (at[0] == mirrored(at[0], counts[0]) && at[1] == mirrored(at[1], counts[1])) {
        own.push_back(i);
      } else {
        weights[i] = 0.5;
      }
    }
  }
}

Counts3 GaussianAtoms::band_counts(std::size_t band) const {
  Counts3 result = grid_.count;
  for (std::size_t axis = 0; axis < 3; ++axis) result[axis] /= bands_[band].spacing[axis];
  return result;
}

GaussianAtoms::Coefficients GaussianAtoms::zeros() const {
  Coefficients result;
  for (const std::vector<double>& weights : weights_) result.emplace_back(weights.size(), 0.0);
  return result;
}

Counts3 GaussianAtoms::frequency_index(std::size_t band, std::size_t index) const {
  const Counts3 counts = band_counts(band);
  Counts3 result = position_of(index, half_counts(counts, HalfAxis::last));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (result[axis] > counts[axis] / 2) result[axis] -= counts[axis];
    result[axis] *= bands_[band].spacing[axis];
  }
  return result;
}

bool GaussianAtoms::is_first_copy(std::size_t band, std::size_t index) const {
  if (weights_[band][index] == 1.0) return true;
  const Counts3 counts = band_counts(band);
  const Counts3 stored = half_counts(counts, HalfAxis::last);
  const Counts3 at = position_of(index, stored);
  const int copy = mirrored(at[0], counts[0]) * counts[1] + mirrored(at[1], counts[1]);
  return at[0] * counts[1] + at[1] < copy;
}

void GaussianAtoms::add_band(std::size_t band, std::span<const double> small, std::size_t row,
                             std::span<double> lags) const {
  const Counts3 counts = band_counts(band);
  const std::array<Axis, 3>& axes = axes_[band];
  const double along_first = axes[0].response[row];
  if (std::abs(along_first) <= kNegligibleResponse * axes[0].response[0]) return;
  const int first = static_cast<int>(row) % counts[0];
  const bool mirror = first > counts[0] / 2;
  const int small_first = mirror ? counts[0] - first : first;
  for (const int t1 : axes[1].used) {
    const double along_two = along_first * axes[1].response[to_size(t1)];
    const int second = t1 % counts[1];
    const int small_second = mirror ? mirrored(second, counts[1]) : second;
    const double* const from =
        small.data() + to_size(small_first * counts[1] + small_second) * to_size(counts[2]);
    double* const to = lags.data() + (row * to_size(grid_.count[1]) + to_size(t1)) * to_size(grid_.count[2]);
    const double* const response = axes[2].response.data();
    const int* const folded = (mirror ? axes[2].mirrored : axes[2].folded).data();
    for (const int t2 : axes[2].used) to[t2] += along_two * response[t2] * from[folded[t2]];
  }
}

void GaussianAtoms::gather_band(std::size_t band, std::span<const double> lags,
                                std::span<double> small) const {
  const Counts3 counts = band_counts(band);
  const std::array<Axis, 3>& axes = axes_[band];
  std::fill(small.begin(), small.end(), 0.0);
  for (const int t0 : axes[0].used) {
    const int small_first = t0 % counts[0];
    if (small_first > counts[0] / 2) continue;
    const bool mirror = t0 > grid_.count[0] / 2;
    const int first = mirror ? grid_.count[0] - t0 : t0;
    for (const int t1 : axes[1].used) {
      const double along_two = axes[0].response[to_size(t0)] * axes[1].response[to_size(t1)];
      const int second = mirror ? mirrored(t1, grid_.count[1]) : t1;
      const double* const from =
          lags.data() + to_size(first * grid_.count[1] + second) * to_size(grid_.count[2]);
      double* const to =
          small.data() + to_size(small_first * counts[1] + t1 % counts[1]) * to_size(counts[2]);
      const double* const response = axes[2].response.data();
      const int* const folded = axes[2].folded.data();
      for (const int t2 : axes[2].used) {
        to[folded[t2]] += along_two * response[t2] * from[mirror ? mirrored(t2, grid_.count[2]) : t2];
      }
    }
  }
}

void GaussianAtoms::synthesize(const Coefficients& x, std::vector<double>& lags) const {
  std::vector<std::vector<double>> small(bands_.size());
  tbb::parallel_for(std::size_t(0), bands_.size(), [&](std::size_t band) {
    std::vector<double> both = x[band];
    for (const std::size_t i : own_mirrors_[band]) both[i] *= 2.0;
    small[band].resize(element_count(half_counts(band_counts(band), HalfAxis::first)));
    band_transforms_[band].to_lags(both, small[band]);
  });
  const std::size_t rows = to_size(grid_.count[0] / 2 + 1);
  lags.assign(element_count(half_counts(grid_.count, HalfAxis::first)), 0.0);
  tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) {
    for (std::size_t band = 0; band < bands_.size(); ++band) add_band(band, small[band], row, lags);
  });
}

void GaussianAtoms::correlate(std::span<const double> lags, Coefficients& x) const {
  x.resize(bands_.size());
  const double scale = 2.0 / static_cast<double>(grid_.size());
  tbb::parallel_for(std::size_t(0), bands_.size(), [&](std::size_t band) {
    std::vector<double> small(element_count(half_counts(band_counts(band), HalfAxis::first)));
    gather_band(band, lags, small);
    for (double& value : small) value *= scale;
    x[band].resize(weights_[band].size());
    band_transforms_[band].to_frequencies(small, x[band]);
  });
}

std::vector<double> GaussianAtoms::lags_of(std::span<const double> spectrum) const {
  const Counts3 stored = half_counts(grid_.count, HalfAxis::last);
  std::vector<double> half(element_count(stored));
  for (std::size_t i = 0; i < half.size(); ++i) {
    const std::size_t row = i / to_size(stored[2]);
    half[i] = spectrum[row * to_size(grid_.count[2]) + i % to_size(stored[2])];
  }
  std::vector<double> lags(element_count(half_counts(grid_.count, HalfAxis::first)));
  transform_.to_lags(half, lags);
  return lags;
}

double GaussianAtoms::dot(std::span<const double> lags_a, std::span<const double> lags_b) const {
  const std::size_t row_size = to_size(grid_.count[1]) * to_size(grid_.count[2]);
  const std::size_t rows = to_size(grid_.count[0] / 2 + 1);
  double total = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    double sum = 0.0;
    for (std::size_t i = row * row_size; i < (row + 1) * row_size; ++i) sum += lags_a[i] * lags_b[i];
    total += mirrored(static_cast<int>(row), grid_.count[0]) == static_cast<int>(row) ? sum : 2.0 * sum;
  }
  return total / static_cast<double>(grid_.size());
}

double GaussianAtoms::dot(const Coefficients& x, const Coefficients& y) const {
  double total = 0.0;
  for (std::size_t band = 0; band < bands_.size(); ++band) {
    for (std::size_t i = 0; i < x[band].size(); ++i) total += weights_[band][i] * x[band][i] * y[band][i];
  }
  return total;
}

double GaussianAtoms::sum(const Coefficients& x) const {
  double total = 0.0;
  for (std::size_t band = 0; band < bands_.size(); ++band) {
    for (std::size_t i = 0; i < x[band].size(); ++i) total += weights_[band][i] * x[band][i];
  }
  return total;
}

// S^T S has no negative elements: from a positive start the power method climbs to its largest eigenvalue.
double GaussianAtoms::norm_squared() const {
  Coefficients x = zeros();
  for (std::vector<double>& values : x) std::fill(values.begin(), values.end(), 1.0);
  std::vector<double> lags;
  double estimate = 0.0;
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    const double length = std::sqrt(dot(x, x));
    for (std::vector<double>& values : x) {
      for (double& value : values) value /= length;
    }
    synthesize(x, lags);
    const double previous = estimate;
    estimate = dot(lags, lags);
    if (estimate - previous < 1e-4 * estimate) break;
    correlate(lags, x);
  }
  return 1.01 * estimate;
}

}  // namespace solidnoise
