#include "solidnoise/analysis/expected_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "solidnoise/analysis/fft.h"

namespace solidnoise {
namespace {

// A function of the distance, by Catmull-Rom interpolation between equidistant values; 0 beyond the last one.
class RadialTable {
 public:
  RadialTable(double spacing, std::vector<double> values)
      : per_unit_(1.0 / spacing), values_(std::move(values)) {}

  double operator()(double r) const {
    const double at = r * per_unit_;
    const std::size_t i = static_cast<std::size_t>(at);
    if (i + 2 >= values_.size()) return 0.0;
    const double t = at - static_cast<double>(i);
    const double before = values_[i == 0 ? 1 : i - 1];  // the function is even
    const double a = values_[i];
    const double b = values_[i + 1];
    const double after = values_[i + 2];
    const double value =
        a + 0.5 * t *
                (b - before +
                 t * (2.0 * before - 5.0 * a + 4.0 * b - after + t * (3.0 * (a - b) + after - before)));
    return std::max(value, 0.0);
  }

 private:
  double per_unit_;
  std::vector<double> values_;
};

// Compares directions along the axes, between them and in general position, at frequencies through the band.
template <int Dim>
bool is_isotropic(const Noise<Dim>& noise) {
  const double upper = noise.band().upper;
  std::vector<Vec<Dim>> directions;
  for (int axis = 0; axis < Dim; ++axis) {
    Vec<Dim> direction(0.0);
    direction[axis] = 1.0;
    directions.push_back(direction);
    direction = Vec<Dim>(1.0);
    direction[axis] = -0.37;
    directions.push_back(direction);
  }
  double highest = 0.0;
  double difference = 0.0;
  for (int i = 1; i <= 16; ++i) {
    const double f = upper * i / 16.0;
    std::vector<double> values;
    for (const Vec<Dim>& direction : directions) {
      double length = 0.0;
      for (int axis = 0; axis < Dim; ++axis) length += direction[axis] * direction[axis];
      values.push_back(noise.power_spectrum(direction * (f / std::sqrt(length))));
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    highest = std::max(highest, *high);
    difference = std::max(difference, *high - *low);
  }
  return difference <= 1e-6 * highest;
}

template <int Dim>
double length_of(const Vec<Dim>& vector) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += vector[axis] * vector[axis];
  return std::sqrt(sum);
}

// |W|^2 at offsets of -reach to +reach half frequency steps; the sum over all offsets is 1.
std::vector<double> leakage(Window window, int n, int reach) {
  std::vector<std::complex<double>> padded(2 * static_cast<std::size_t>(n));
  const std::vector<double> values = window_values(window, n);
  std::copy(values.begin(), values.end(), padded.begin());
  const int length = 2 * n;
  fft(padded, std::array<int, 1>{length}, FftDirection::forward);
  double sum = 0.0;
  for (const std::complex<double>& value : padded) sum += std::norm(value);
  std::vector<double> result;
  for (int j = -reach; j <= reach; ++j) {
    result.push_back(std::norm(padded[static_cast<std::size_t>((j + length) % length)]) / sum);
  }
  return result;
}

// Smooths along one axis of 2n half steps and keeps every second value.
template <int Dim>
void smooth_axis(std::vector<double>& values, ArrayShape<Dim>& shape, int axis, Window window) {
  const int length = shape.count[axis];
  const int reach = std::min(24, length / 2 - 1);
  const std::vector<double> kernel =
      window == Window::none ? std::vector<double>{1.0} : leakage(window, length / 2, reach);
  const int half = static_cast<int>(kernel.size()) / 2;
  const std::size_t stride = shape.stride(axis);
  ArrayShape<Dim> smaller = shape;
  smaller.count[axis] = length / 2;
  std::vector<double> result(smaller.size());
  const std::size_t lines = shape.size() / static_cast<std::size_t>(length);
  for (std::size_t line = 0; line < lines; ++line) {
    const std::size_t outer = line / stride;
    const std::size_t inner = line % stride;
    const double* const source = values.data() + outer * stride * static_cast<std::size_t>(length) + inner;
    double* const target = result.data() + outer * stride * static_cast<std::size_t>(length / 2) + inner;
    for (int k = 0; k < length / 2; ++k) {
      double sum = 0.0;
      for (int j = -half; j <= half; ++j) {
        const int from = (2 * k - j + 2 * length) % length;
        sum += kernel[static_cast<std::size_t>(j + half)] * source[static_cast<std::size_t>(from) * stride];
      }
      target[static_cast<std::size_t>(k) * stride] = sum;
    }
  }
  values = std::move(result);
  shape = smaller;
}

// The density at one frequency of the sampled field: the sum over its images.
template <int Dim>
double folded(const SpectralDensity<Dim>& density, const Vec<Dim>& frequency, const Vec<Dim>& rate) {
  constexpr int kImages = 3;
  glm::vec<Dim, int> first(0);
  glm::vec<Dim, int> last(0);
  for (int axis = 0; axis < Dim; ++axis) {
    const double low = (-density.reach - frequency[axis]) / rate[axis];
    const double high = (density.reach - frequency[axis]) / rate[axis];
    first[axis] = static_cast<int>(std::max(std::ceil(low), -double{kImages}));
    last[axis] = static_cast<int>(std::min(std::floor(high), double{kImages}));
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
SpectralDensity<Dim> spectral_density(const Noise<Dim>& noise, double block_length) {
  const double upper = noise.band().upper;
  if (!is_isotropic(noise)) {
    return {[&noise](const Vec<Dim>& frequency) { return noise.power_spectrum(frequency); }, 2.0 * upper};
  }
  const double reach = 4.0 * upper;
  const double spacing = 1.0 / (32.0 * block_length);
  std::vector<double> values;
  for (double f = 0.0; f < reach + 3.0 * spacing; f += spacing) {
    Vec<Dim> frequency(0.0);
    frequency[0] = f;
    values.push_back(noise.power_spectrum(frequency));
  }
  const auto table = std::make_shared<const RadialTable>(spacing, std::move(values));
  return {[table](const Vec<Dim>& frequency) { return (*table)(length_of<Dim>(frequency)); }, reach};
}

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
                                        const Vec<Dim>& step, Window window) {
  double longest = 0.0;
  for (int axis = 0; axis < Dim; ++axis) longest = std::max(longest, step[axis] * count[axis]);
  return expected_periodogram(spectral_density(noise, longest), count, step, window);
}

template SpectralDensity<1> spectral_density<1>(const Noise<1>&, double);
template SpectralDensity<2> spectral_density<2>(const Noise<2>&, double);
template SpectralDensity<3> spectral_density<3>(const Noise<3>&, double);
template PowerSpectrum<1> expected_periodogram<1>(const SpectralDensity<1>&, const glm::vec<1, int>&,
                                                  const Vec<1>&, Window);
template PowerSpectrum<2> expected_periodogram<2>(const SpectralDensity<2>&, const glm::vec<2, int>&,
                                                  const Vec<2>&, Window);
template PowerSpectrum<3> expected_periodogram<3>(const SpectralDensity<3>&, const glm::vec<3, int>&,
                                                  const Vec<3>&, Window);
template PowerSpectrum<1> expected_periodogram<1>(const Noise<1>&, const glm::vec<1, int>&, const Vec<1>&,
                                                  Window);
template PowerSpectrum<2> expected_periodogram<2>(const Noise<2>&, const glm::vec<2, int>&, const Vec<2>&,
                                                  Window);
template PowerSpectrum<3> expected_periodogram<3>(const Noise<3>&, const glm::vec<3, int>&, const Vec<3>&,
                                                  Window);

}  // namespace solidnoise
