#include "solidnoise/analysis/periodogram.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/analysis/fft.h"
#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

std::vector<double> squares(std::vector<double> values) {
  for (double& value : values) value *= value;
  return values;
}

// The length of data that a weighted count of points sees along one axis: (sum v)^2 / sum v^2 samples.
double effective_length(const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  return sum * sum / std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
}

}  // namespace

std::vector<double> window_values(Window window, int n) {
  std::vector<double> values(static_cast<std::size_t>(n), 1.0);
  if (window == Window::none) return values;
  for (int j = 0; j < n; ++j) {
    const double s = std::sin(std::numbers::pi * j / n);
    values[static_cast<std::size_t>(j)] = s * s;
  }
  return values;
}

template <int Dim>
double PowerSpectrum<Dim>::cell() const {
  double result = 1.0;
  for (int axis = 0; axis < Dim; ++axis) result *= frequency_step(axis);
  return result;
}

template <int Dim>
double PowerSpectrum<Dim>::variance() const {
  return cell() * std::accumulate(density.begin(), density.end(), 0.0);
}

template <int Dim>
Vec<Dim> PowerSpectrum<Dim>::frequency(std::size_t index) const {
  const glm::vec<Dim, int> stored = ArrayShape<Dim>{count}.position(index);
  Vec<Dim> result(0.0);
  for (int axis = 0; axis < Dim; ++axis) {
    result[axis] = signed_index(stored[axis], count[axis]) * frequency_step(axis);
  }
  return result;
}

template <int Dim>
PeriodogramAverage<Dim>::PeriodogramAverage(const glm::vec<Dim, int>& count, const Vec<Dim>& step,
                                            const PeriodogramOptions& options)
    : options_(options) {
  for (int axis = 0; axis < Dim; ++axis) {
    require_at_least("periodogram block", count[axis], 2, "samples");
    require_positive("periodogram step", step[axis], "world units");
    axis_windows_[axis] = window_values(options.window, count[axis]);
    double energy = 0.0;
    for (const double w : axis_windows_[axis]) energy += w * w;
    window_energy_ *= energy;
  }
  sum_.count = count;
  sum_.step = step;
  sum_.window = options.window;
  sum_.density.assign(ArrayShape<Dim>{count}.size(), 0.0);
}

template <int Dim>
void PeriodogramAverage<Dim>::add(std::span<const float> block) {
  if (block.size() != sum_.density.size()) {
    throw std::invalid_argument(
        fmt::format("periodogram block has {} values; it must have {}", block.size(), sum_.density.size()));
  }
  std::vector<double> windowed(block.size());
  const std::vector<double>& row_window = axis_windows_[Dim - 1];
  for (std::size_t row = 0; row < block.size(); row += row_window.size()) {
    const glm::vec<Dim, int> at = ArrayShape<Dim>{sum_.count}.position(row);
    double weight = 1.0;
    for (int axis = 0; axis < Dim - 1; ++axis)
      weight *= axis_windows_[axis][static_cast<std::size_t>(at[axis])];
    for (std::size_t i = 0; i < row_window.size(); ++i) {
      windowed[row + i] = weight * row_window[i] * (block[row + i] - options_.mean);
    }
  }

  std::array<int, Dim> counts;
  double scale = 1.0 / window_energy_;
  for (int axis = 0; axis < Dim; ++axis) {
    counts[static_cast<std::size_t>(axis)] = sum_.count[axis];
    scale *= sum_.step[axis];
  }
  const std::vector<std::complex<double>> coefficients = fft_of_real(windowed, counts);
  for (std::size_t i = 0; i < block.size(); ++i) sum_.density[i] += scale * std::norm(coefficients[i]);
  ++blocks_;
}

template <int Dim>
PowerSpectrum<Dim> PeriodogramAverage<Dim>::spectrum() const {
  PowerSpectrum<Dim> result = sum_;
  result.independent_blocks = blocks_;
  result.effective_volume = blocks_;
  for (int axis = 0; axis < Dim; ++axis) {
    result.effective_volume *= result.step[axis] * effective_length(squares(axis_windows_[axis]));
  }
  for (double& density : result.density) density /= blocks_;
  return result;
}

template <int Dim>
PowerSpectrum<Dim> periodogram(const DenseField<Dim>& field, const PeriodogramOptions& options) {
  PeriodogramAverage<Dim> average(field.count, field.step, options);
  average.add(field.values);
  return average.spectrum();
}

template struct PowerSpectrum<1>;
template struct PowerSpectrum<2>;
template struct PowerSpectrum<3>;
template class PeriodogramAverage<1>;
template class PeriodogramAverage<2>;
template class PeriodogramAverage<3>;
template PowerSpectrum<1> periodogram<1>(const DenseField<1>&, const PeriodogramOptions&);
template PowerSpectrum<2> periodogram<2>(const DenseField<2>&, const PeriodogramOptions&);
template PowerSpectrum<3> periodogram<3>(const DenseField<3>&, const PeriodogramOptions&);

}  // namespace solidnoise
