#include "solidnoise/analysis/fft.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>
#include <kissfft/kissfft.hh>

namespace solidnoise {
namespace {

using Complex = std::complex<double>;
using Plan = kissfft<double>;

std::size_t checked_size(std::size_t values, std::span<const int> counts) {
  std::size_t size = 1;
  for (const int count : counts) {
    if (count < 1) throw std::invalid_argument(fmt::format("FFT count is {}; it must be at least 1", count));
    size *= static_cast<std::size_t>(count);
  }
  if (size != values) {
    throw std::invalid_argument(fmt::format("FFT of {} values with counts for {}", values, size));
  }
  return size;
}

// Transforms along one axis whose neighbours are `stride` apart. Lines are gathered several at a time, so
// that each cache line that is read serves all of them.
void transform_axis(std::span<Complex> data, int count, std::size_t stride, FftDirection direction) {
  if (count == 1) return;
  constexpr std::size_t kLinesAtOnce = 8;
  const std::size_t length = static_cast<std::size_t>(count);
  const Plan plan(length, direction == FftDirection::inverse);
  std::vector<Complex> gathered(kLinesAtOnce * length);
  std::vector<Complex> transformed(length);
  for (std::size_t block = 0; block < data.size(); block += stride * length) {
    for (std::size_t first = 0; first < stride; first += kLinesAtOnce) {
      const std::size_t lines = std::min(kLinesAtOnce, stride - first);
      Complex* const base = data.data() + block + first;
      for (std::size_t i = 0; i < length; ++i) {
        for (std::size_t line = 0; line < lines; ++line)
          gathered[line * length + i] = base[i * stride + line];
      }
      for (std::size_t line = 0; line < lines; ++line) {
        plan.transform(&gathered[line * length], transformed.data());
        std::copy(transformed.begin(), transformed.end(), &gathered[line * length]);
      }
      for (std::size_t i = 0; i < length; ++i) {
        for (std::size_t line = 0; line < lines; ++line)
          base[i * stride + line] = gathered[line * length + i];
      }
    }
  }
}

// Transforms each row of real values into its first length/2 + 1 coefficients. Two rows are one complex
// transform: with z = a + i b, A_k = (Z_k + conj Z_-k) / 2 and B_k = (Z_k - conj Z_-k) / 2i.
std::vector<Complex> transform_rows(std::span<const double> values, std::size_t length) {
  const std::size_t half = length / 2 + 1;
  const std::size_t rows = values.size() / length;
  std::vector<Complex> result(rows * half);
  const Plan plan(length, false);
  std::vector<Complex> pair(length);
  std::vector<Complex> transformed(length);
  for (std::size_t row = 0; row < rows; row += 2) {
    const bool has_second = row + 1 < rows;
    const double* const a = values.data() + row * length;
    for (std::size_t i = 0; i < length; ++i) pair[i] = Complex(a[i], has_second ? a[length + i] : 0.0);
    plan.transform(pair.data(), transformed.data());
    for (std::size_t k = 0; k < half; ++k) {
      const Complex z = transformed[k];
      const Complex mirrored = std::conj(transformed[(length - k) % length]);
      result[row * half + k] = 0.5 * (z + mirrored);
      if (has_second) result[(row + 1) * half + k] = Complex(0.0, -0.5) * (z - mirrored);
    }
  }
  return result;
}

// The row of coefficients at the negated frequency of every axis but the last.
std::size_t mirrored_row(std::size_t row, std::span<const int> outer_counts) {
  std::size_t mirrored = 0;
  std::size_t stride = 1;
  for (std::size_t axis = outer_counts.size(); axis-- > 0;) {
    const std::size_t count = static_cast<std::size_t>(outer_counts[axis]);
    const std::size_t k = row / stride % count;
    mirrored += (count - k) % count * stride;
    stride *= count;
  }
  return mirrored;
}

}  // namespace

void fft(std::span<Complex> data, std::span<const int> counts, FftDirection direction) {
  checked_size(data.size(), counts);
  std::size_t stride = 1;
  for (std::size_t axis = counts.size(); axis-- > 0;) {
    transform_axis(data, counts[axis], stride, direction);
    stride *= static_cast<std::size_t>(counts[axis]);
  }
}

std::vector<Complex> fft_of_real(std::span<const double> values, std::span<const int> counts) {
  const std::size_t size = checked_size(values.size(), counts);
  if (counts.empty()) return {Complex(values[0])};
  const std::size_t length = static_cast<std::size_t>(counts.back());
  const std::size_t half = length / 2 + 1;
  const std::span<const int> outer = counts.first(counts.size() - 1);

  std::vector<Complex> coefficients = transform_rows(values, length);
  std::size_t stride = half;
  for (std::size_t axis = outer.size(); axis-- > 0;) {
    transform_axis(coefficients, outer[axis], stride, FftDirection::forward);
    stride *= static_cast<std::size_t>(outer[axis]);
  }

  // The other half of the coefficients: X_-k = conj X_k.
  std::vector<Complex> all(size);
  for (std::size_t row = 0; row < size / length; ++row) {
    const std::size_t mirror = mirrored_row(row, outer);
    std::copy_n(&coefficients[row * half], half, &all[row * length]);
    for (std::size_t k = half; k < length; ++k) {
      all[row * length + k] = std::conj(coefficients[mirror * half + length - k]);
    }
  }
  return all;
}

}  // namespace solidnoise
