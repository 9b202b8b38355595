#include "solidnoise/analysis/field_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "solidnoise/analysis/fft.h"
#include "solidnoise/analysis/periodogram.h"

namespace solidnoise {
namespace {

// Bilinear interpolation at a position in samples; beyond the ends the outermost samples go on.
double interpolated(const DenseField<2>& field, double x, double y) {
  x = std::clamp(x, 0.0, field.count.x - 1.0);
  y = std::clamp(y, 0.0, field.count.y - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(0, field.count.x - 2));
  const int j = std::min(static_cast<int>(y), std::max(0, field.count.y - 2));
  const int next_i = std::min(i + 1, field.count.x - 1);
  const int next_j = std::min(j + 1, field.count.y - 1);
  const double s = x - i;
  const double t = y - j;
  const ArrayShape<2> shape{field.count};
  const auto at = [&](int a, int b) { return static_cast<double>(field.values[shape.index({a, b})]); };
  return (1.0 - s) * ((1.0 - t) * at(i, j) + t * at(i, next_j)) +
         s * ((1.0 - t) * at(next_i, j) + t * at(next_i, next_j));
}

}  // namespace

Image field_picture(const DenseField<2>& field, int size, const ColorRamp& ramp, double lower, double upper) {
  const double side = std::min(field.count.x * field.step.x, field.count.y * field.step.y);
  const double pixel_x = side / field.step.x / size;  // samples per pixel
  const double pixel_y = side / field.step.y / size;
  const double left = 0.5 * field.count.x - 0.5 * pixel_x * size - 0.5;
  const double bottom = 0.5 * field.count.y - 0.5 * pixel_y * size - 0.5;
  const int points = static_cast<int>(std::ceil(std::max({pixel_x, pixel_y, 1.0})));  // per pixel and axis

  Image image(size, size, 3);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      double sum = 0.0;
      for (int i = 0; i < points; ++i) {
        for (int j = 0; j < points; ++j) {
          sum += interpolated(field, left + (column + (i + 0.5) / points) * pixel_x,
                              bottom + (size - row - (j + 0.5) / points) * pixel_y);
        }
      }
      const double value = sum / (points * points);
      const Color color = ramp.srgb(static_cast<float>((value - lower) / (upper - lower)));
      for (int channel = 0; channel < 3; ++channel) image.at(column, row, channel) = color[channel];
    }
  }
  return image;
}

DenseField<2> spectrum_magnitude(const DenseField<2>& field, SpectrumWindow window, int count) {
  const Window kind = window == SpectrumWindow::hann ? Window::hann : Window::none;
  const std::vector<double> window_x = window_values(kind, field.count.x);
  const std::vector<double> window_y = window_values(kind, field.count.y);
  const ArrayShape<2> shape{field.count};
  const ArrayShape<2> padded{{std::max(count, field.count.x), std::max(count, field.count.y)}};
  std::vector<double> values(padded.size());
  for (int i = 0; i < field.count.x; ++i) {
    for (int j = 0; j < field.count.y; ++j) {
      values[padded.index({i, j})] = window_x[static_cast<std::size_t>(i)] *
                                     window_y[static_cast<std::size_t>(j)] *
                                     field.values[shape.index({i, j})];
    }
  }
  const std::vector<std::complex<double>> transform =
      fft_of_real(values, std::array<int, 2>{padded.count.x, padded.count.y});

  double highest = 0.0;
  for (const std::complex<double>& value : transform) highest = std::max(highest, std::abs(value));
  // An odd number of frequencies, from -count / 2 to count / 2, puts 0 in the middle.
  const glm::ivec2 half = padded.count / 2;
  DenseField<2> result(2 * half + 1, 1.0 / (field.step * Vec<2>(padded.count)));
  const ArrayShape<2> result_shape{result.count};
  for (std::size_t index = 0; index < result.values.size(); ++index) {
    const glm::ivec2 k = result_shape.position(index) - half;
    const std::size_t from = padded.index((k + padded.count) % padded.count);
    const double magnitude = highest > 0.0 ? std::abs(transform[from]) / highest : 0.0;
    result.values[index] = static_cast<float>(std::log1p(200.0 * magnitude) / std::log(201.0));
  }
  return result;
}

DenseField<2> middle_part(const DenseField<2>& field, double width) {
  glm::ivec2 count;
  for (int axis = 0; axis < 2; ++axis) {
    // As odd or even as before, so that the middle stays in the middle.
    const int kept = static_cast<int>(std::ceil(width / field.step[axis]));
    count[axis] =
        std::clamp(kept + (field.count[axis] - kept) % 2, std::min(2, field.count[axis]), field.count[axis]);
  }
  const glm::ivec2 first = (field.count - count) / 2;
  DenseField<2> part(count, field.step);
  const ArrayShape<2> shape{count};
  for (std::size_t index = 0; index < part.values.size(); ++index) {
    part.values[index] = field.values[ArrayShape<2>{field.count}.index(first + shape.position(index))];
  }
  return part;
}

}  // namespace solidnoise
