#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/fft.h"
#include "solidnoise/core/random.h"

namespace solidnoise {

// Two independent draws of the standard normal distribution (Box and Muller).
inline std::complex<double> next_normal_pair(RandomStream& stream) {
  const double first = 1.0 - stream.next_unit();
  const double second = stream.next_unit();
  const double radius = std::sqrt(-2.0 * std::log(first));
  return std::polar(radius, 2.0 * std::numbers::pi * second);
}

template <int Dim>
DenseField<Dim> white_field(const glm::vec<Dim, int>& count, const Vec<Dim>& step, std::uint64_t seed) {
  DenseField<Dim> field(count, step);
  RandomStream stream(mix_bits(seed + 1));
  for (float& value : field.values) value = static_cast<float>(next_normal_pair(stream).real());
  return field;
}

// A Gaussian field with a given density, which must be negligible beyond the Nyquist frequency: filtered
// white noise, periodic over `period` samples per axis, of which the first `count` are kept.
template <int Dim>
DenseField<Dim> gaussian_field(const std::function<double(const Vec<Dim>&)>& density, int period,
                               const glm::vec<Dim, int>& count, const Vec<Dim>& step, std::uint64_t seed) {
  const ArrayShape<Dim> shape{glm::vec<Dim, int>(period)};
  std::vector<int> counts(Dim, period);
  RandomStream stream(mix_bits(seed + 1));
  std::vector<std::complex<double>> values(shape.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::vec<Dim, int> k = shape.position(i);
    Vec<Dim> frequency(0.0);
    double cell = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      frequency[axis] = (k[axis] > period / 2 ? k[axis] - period : k[axis]) / (step[axis] * period);
      cell /= step[axis] * period;
    }
    values[i] = std::sqrt(density(frequency) * cell) * next_normal_pair(stream);
  }
  // The real part of the transform of independent complex coefficients has this density.
  fft(values, counts, FftDirection::inverse);
  DenseField<Dim> field(count, step);
  const ArrayShape<Dim> kept{count};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    field.values[i] = static_cast<float>(values[shape.index(kept.position(i))].real());
  }
  return field;
}

}  // namespace solidnoise
