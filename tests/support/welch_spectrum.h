#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/analysis/periodogram.h"

namespace solidnoise {

inline double sum_of_products(const std::vector<double>& weights, int shift) {
  double sum = 0.0;
  for (std::size_t j = 0; j + static_cast<std::size_t>(shift) < weights.size(); ++j) {
    sum += weights[j] * weights[j + static_cast<std::size_t>(shift)];
  }
  return sum;
}

// Variance of the mean of `blocks` equal things, relative to that of one, if neighbours correlate.
inline double relative_variance(double correlation, int blocks) {
  return (blocks + 2.0 * (blocks - 1) * correlation) / (static_cast<double>(blocks) * blocks);
}

// Welch's method on one field: the average of Hann-windowed periodograms over blocks that overlap by half.
// What is left over at the upper ends is not used. Precondition: a block is no larger than the field.
template <int Dim>
PowerSpectrum<Dim> welch_spectrum(const DenseField<Dim>& field, const glm::vec<Dim, int>& block_count) {
  PeriodogramAverage<Dim> average(block_count, field.step);
  const glm::vec<Dim, int> shift = block_count / 2;
  ArrayShape<Dim> blocks;
  double spectrum_variance = 1.0;
  double count_variance = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    blocks.count[axis] = (field.count[axis] - block_count[axis]) / shift[axis] + 1;
    // Two blocks' periodograms correlate by the square of the windows' correlation, and the impulses they
    // count by the correlation of the squared windows.
    const std::vector<double> window = window_values(Window::hann, block_count[axis]);
    std::vector<double> squares = window;
    for (double& value : squares) value *= value;
    const double overlap = sum_of_products(window, shift[axis]) / sum_of_products(window, 0);
    const double shared = sum_of_products(squares, shift[axis]) / sum_of_products(squares, 0);
    spectrum_variance *= relative_variance(overlap * overlap, blocks.count[axis]);
    count_variance *= relative_variance(shared, blocks.count[axis]);
  }

  const ArrayShape<Dim> shape{block_count};
  std::vector<float> block(shape.size());
  for (std::size_t index = 0; index < blocks.size(); ++index) {
    const glm::vec<Dim, int> first = blocks.position(index) * shift;
    for (std::size_t i = 0; i < block.size(); ++i) {
      block[i] = field.values[ArrayShape<Dim>{field.count}.index(first + shape.position(i))];
    }
    average.add(block);
  }
  PowerSpectrum<Dim> result = average.spectrum();
  result.effective_volume *= 1.0 / (count_variance * static_cast<double>(blocks.size()));
  result.independent_blocks = 1.0 / spectrum_variance;
  return result;
}

}  // namespace solidnoise
