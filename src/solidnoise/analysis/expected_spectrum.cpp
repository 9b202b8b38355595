#include "solidnoise/analysis/expected_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "solidnoise/analysis/fft.h"

namespace solidnoise {
namespace {

template <int Dim>
double length_of(const Vec<Dim>& vector) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += vector[axis] * vector[axis];
  return std::sqrt(sum);
}

struct Leak {
  int offset;  // half frequency steps
  double share;
};

// |W|^2 up to 24 half steps away, where a Hann window's has fallen to 1e-9; the sum over all offsets is 1.
std::vector<Leak> leakage(Window window, int n) {
  if (window == Window::none) return {{0, 1.0}};
  std::vector<std::complex<double>> padded(2 * static_cast<std::size_t>(n));
  const std::vector<double> values = window_values(window, n);
  std::copy(values.begin(), values.end(), padded.begin());
  fft(padded, std::array<int, 1>{2 * n}, FftDirection::forward);
  double sum = 0.0;
  for (const std::complex<double>& value : padded) sum += std::norm(value);

  const int reach = std::min(24, n - 1);
  std::vector<Leak> result;
  for (int offset = -reach; offset <= reach; ++offset) {
    const double share = std::norm(padded[static_cast<std::size_t>((offset + 2 * n) % (2 * n))]) / sum;
    if (share > 1e-16) result.push_back({offset, share});
  }
  return result;
}

// Smooths along one axis of 2n half steps and keeps every second value.
template <int Dim>
void smooth_axis(std::vector<double>& values, ArrayShape<Dim>& shape, int axis, Window window) {
  const int length = shape.count[axis];
  const std::vector<Leak> leaks = leakage(window, length / 2);
  const std::size_t stride = shape.stride(axis);
  const std::size_t blocks = shape.size() / (stride * static_cast<std::size_t>(length));
  ArrayShape<Dim> smaller = shape;
  smaller.count[axis] = length / 2;
  std::vector<double> result(smaller.size());
  for (std::size_t block = 0; block < blocks; ++block) {
    const double* const source = values.data() + block * stride * static_cast<std::size_t>(length);
    double* const target = result.data() + block * stride * static_cast<std::size_t>(length / 2);
    for (int k = 0; k < length / 2; ++k) {
      double* const row = target + static_cast<std::size_t>(k) * stride;
      for (const Leak& leak : leaks) {
        const int from = (2 * k - leak.offset + length) % length;
        const double* const other = source + static_cast<std::size_t>(from) * stride;
        for (std::size_t i = 0; i < stride; ++i) row[i] += leak.share * other[i];
      }
    }
  }
  values = std::move(result);
  shape = smaller;
}

// The density at one frequency of the sampled field: the sum over its images.
template <int Dim>
double folded(const SpectralDensity<Dim>& density, const Vec<Dim>& frequency, const Vec<Dim>& rate) {
  constexpr int kMostImages = 3;
  glm::vec<Dim, int> first(0);
  glm::vec<Dim, int> last(0);
  for (int axis = 0; axis < Dim; ++axis) {
    const double low = (-density.reach - frequency[axis]) / rate[axis];
    const double high = (density.reach - frequency[axis]) / rate[axis];
    first[axis] = static_cast<int>(std::max(std::ceil(low), -double{kMostImages}));
    last[axis] = static_cast<int>(std::min(std::floor(high), double{kMostImages}));
    if (last[axis] < first[axis]) return 0.0;
  }
  double sum = 0.0;
  glm::vec<Dim, int> image = first;
  while (true) {
    const Vec<Dim> at = frequency + Vec<Dim>(image) * rate;
    if (length_of<Dim>(at) <= density.reach) sum += density.density(at);
    int axis = Dim - 1;
    while (axis >= 0 && ++image[axis] > last[axis]) {
      image[axis] = first[axis];
      --axis;
    }
    if (axis < 0) return sum;
  }
}

}  // namespace

template <int Dim>
PowerSpectrum<Dim> expected_periodogram(const SpectralDensity<Dim>& density, const glm::vec<Dim, int>& count,
                                        const Vec<Dim>& step, Window window) {
  PowerSpectrum<Dim> result;
  result.count = count;
  result.step = step;
  result.window = window;

  // The folded density at half steps of frequency. It is even: half of it is evaluated.
  ArrayShape<Dim> shape{count * 2};
  std::vector<double> values(shape.size());
  for (std::size_t index = 0; index < values.size(); ++index) {
    const glm::vec<Dim, int> position = shape.position(index);
    glm::vec<Dim, int> mirrored(0);
    Vec<Dim> frequency(0.0);
    for (int axis = 0; axis < Dim; ++axis) {
      const int length = shape.count[axis];
      const int k = position[axis];
      frequency[axis] = PowerSpectrum<Dim>::signed_index(k, length) / (step[axis] * length);
      mirrored[axis] = (length - k) % length;
    }
    const std::size_t mirror = shape.index(mirrored);
    values[index] = mirror < index ? values[mirror] : folded(density, frequency, 1.0 / step);
  }
  for (int axis = 0; axis < Dim; ++axis) smooth_axis(values, shape, axis, window);
  result.density = std::move(values);
  return result;
}

template <int Dim>
PowerSpectrum<Dim> expected_periodogram(const Noise<Dim>& noise, const glm::vec<Dim, int>& count,
                                        const Vec<Dim>& step, Window window,
                                        const std::optional<Vec<Dim>>& axis) {
  double longest = 0.0;
  for (int i = 0; i < Dim; ++i) longest = std::max(longest, step[i] * count[i]);
  return expected_periodogram(spectral_density(noise, longest, axis), count, step, window);
}

template PowerSpectrum<1> expected_periodogram<1>(const SpectralDensity<1>&, const glm::vec<1, int>&,
                                                  const Vec<1>&, Window);
template PowerSpectrum<2> expected_periodogram<2>(const SpectralDensity<2>&, const glm::vec<2, int>&,
                                                  const Vec<2>&, Window);
template PowerSpectrum<3> expected_periodogram<3>(const SpectralDensity<3>&, const glm::vec<3, int>&,
                                                  const Vec<3>&, Window);
template PowerSpectrum<1> expected_periodogram<1>(const Noise<1>&, const glm::vec<1, int>&, const Vec<1>&,
                                                  Window, const std::optional<Vec<1>>&);
template PowerSpectrum<2> expected_periodogram<2>(const Noise<2>&, const glm::vec<2, int>&, const Vec<2>&,
                                                  Window, const std::optional<Vec<2>>&);
template PowerSpectrum<3> expected_periodogram<3>(const Noise<3>&, const glm::vec<3, int>&, const Vec<3>&,
                                                  Window, const std::optional<Vec<3>>&);

}  // namespace solidnoise
