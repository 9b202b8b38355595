#include "solidnoise/analysis/exemplar/gaussian_field.h"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/analysis/fft.h"
#include "solidnoise/core/random.h"

namespace solidnoise {

template <int Dim>
DenseField<Dim> periodic_component(const DenseField<Dim>& field) {
  const ArrayShape<Dim> shape{field.count};
  std::vector<std::complex<double>> jumps(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto position = shape.position(i);
    for (int axis = 0; axis < Dim; ++axis) {
      const int last = field.count[axis] - 1;
      if (position[axis] != 0 && position[axis] != last) continue;
      auto opposite = position;
      opposite[axis] = last - position[axis];
      jumps[i] += static_cast<double>(field.values[shape.index(opposite)]) - field.values[i];
    }
  }

  const std::vector<int> counts(&field.count[0], &field.count[0] + Dim);
  fft(jumps, counts, FftDirection::forward);
  jumps[0] = 0.0;
  for (std::size_t i = 1; i < field.size(); ++i) {
    const auto k = shape.position(i);
    double laplacian = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      laplacian += 2.0 * std::cos(2.0 * std::numbers::pi * k[axis] / field.count[axis]) - 2.0;
    }
    jumps[i] /= laplacian;
  }
  fft(jumps, counts, FftDirection::inverse);

  DenseField<Dim> result = field;
  for (std::size_t i = 0; i < field.size(); ++i) {
    result.values[i] -= static_cast<float>(jumps[i].real() / static_cast<double>(field.size()));
  }
  return result;
}

template DenseField<2> periodic_component<2>(const DenseField<2>&);
template DenseField<3> periodic_component<3>(const DenseField<3>&);

namespace {

using Complex = std::complex<double>;

constexpr int kBandImages = 2;  // of the samples' band of frequencies, to each side
constexpr double kNegligibleHeight = 1e-12;

// exp(-2 pi (f - w)^2 / a^2) at the frequencies of one axis, with images.
std::vector<double> gaussian_row(double a, double w, double step, int count) {
  std::vector<double> row(static_cast<std::size_t>(count), 0.0);
  for (int k = 0; k < count; ++k) {
    for (int image = -kBandImages; image <= kBandImages; ++image) {
      const double f = (step * (k + image * count) - w) / a;
      row[static_cast<std::size_t>(k)] += std::exp(-2.0 * std::numbers::pi * f * f);
    }
  }
  return row;
}

template <int Dim>
void add_gaussian(const std::array<std::vector<double>, Dim>& rows, double height, std::vector<double>& sum) {
  const std::size_t last_count = rows[Dim - 1].size();
  for (std::size_t start = 0; start < sum.size(); start += last_count) {
    double factor = height;
    std::size_t index = start / last_count;
    for (std::size_t axis = Dim - 1; axis-- > 0;) {
      factor *= rows[axis][index % rows[axis].size()];
      index /= rows[axis].size();
    }
    if (factor < kNegligibleHeight * height) continue;
    for (std::size_t i = 0; i < last_count; ++i) sum[start + i] += factor * rows[Dim - 1][i];
  }
}

// The index of the negated frequency.
template <int Dim>
std::size_t mirrored(std::size_t index, const ArrayShape<Dim>& shape) {
  auto position = shape.position(index);
  for (int axis = 0; axis < Dim; ++axis) {
    position[axis] = position[axis] == 0 ? 0 : shape.count[axis] - position[axis];
  }
  return shape.index(position);
}

// Uniform phases that are odd, as those of a real field: 0 or pi where the frequency is its own mirror image.
template <int Dim>
std::vector<double> random_phases(const ArrayShape<Dim>& shape, std::uint64_t seed) {
  std::vector<double> phases(shape.size());
  RandomStream stream(derive_seed(seed, 0x9a5e));
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const std::size_t mirror = mirrored(i, shape);
    const double turn = stream.next_unit();
    if (mirror < i) {
      phases[i] = -phases[mirror];
    } else if (mirror == i) {
      phases[i] = turn < 0.5 ? 0.0 : std::numbers::pi;
    } else {
      phases[i] = 2.0 * std::numbers::pi * turn;
    }
  }
  return phases;
}

template <int Dim>
DenseField<Dim> inverse(std::vector<Complex>& coefficients, const glm::vec<Dim, int>& count,
                        const Vec<Dim>& step) {
  const std::vector<int> counts(&count[0], &count[0] + Dim);
  fft(coefficients, counts, FftDirection::inverse);
  DenseField<Dim> field(count, step);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    field.values[i] = static_cast<float>(coefficients[i].real());
  }
  return field;
}

}  // namespace

template <int Dim>
PowerSpectrum<Dim> sampled_density(const GaborSpectrum& spectrum, const glm::vec<Dim, int>& count,
                                   const Vec<Dim>& step) {
  PowerSpectrum<Dim> result;
  result.count = count;
  result.step = step;
  result.window = Window::none;
  result.density.assign(ArrayShape<Dim>{count}.size(), 0.0);
  if (spectrum.isotropic) {
    for (std::size_t i = 0; i < result.density.size(); ++i) {
      Vec<3> frequency(0.0);
      const Vec<Dim> f = result.frequency(i);
      for (int axis = 0; axis < Dim; ++axis) frequency[axis] = f[axis];
      result.density[i] = spectrum.density(frequency);
    }
    return result;
  }
  for (const SpectrumBand& band : spectrum.bands) {
    const double height = 0.5 * std::pow(std::numbers::sqrt2 / band.a, Dim);
    for (const SpectrumComponent& component : band.components) {
      for (const double sign : {-1.0, 1.0}) {
        std::array<std::vector<double>, Dim> rows;
        for (int axis = 0; axis < Dim; ++axis) {
          rows[static_cast<std::size_t>(axis)] = gaussian_row(band.a, sign * component.frequency[axis],
                                                              result.frequency_step(axis), count[axis]);
        }
        add_gaussian<Dim>(rows, height * component.variance, result.density);
      }
    }
  }
  return result;
}

template <int Dim>
Exemplar<Dim> gaussian_version(const Exemplar<Dim>& exemplar, std::uint64_t seed) {
  const ArrayShape<Dim> shape{exemplar.shape().count};
  const std::vector<double> phases = random_phases(shape, seed);
  const std::vector<int> counts(&shape.count[0], &shape.count[0] + Dim);
  Exemplar<Dim> result;
  for (const DenseField<Dim>& channel : exemplar.channels) {
    const DenseField<Dim> periodic = periodic_component(channel);
    std::vector<Complex> coefficients =
        fft_of_real(std::vector<double>(periodic.values.begin(), periodic.values.end()), counts);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      if (i > 0) coefficients[i] *= std::polar(1.0, phases[i]);
      coefficients[i] /= static_cast<double>(shape.size());
    }
    result.channels.push_back(inverse(coefficients, channel.count, channel.step));
  }
  return result;
}

template <int Dim>
DenseField<Dim> gaussian_field(const PowerSpectrum<Dim>& spectrum, std::uint64_t seed) {
  // Independent complex normal coefficients, by Box and Muller, with the conjugate at the negated frequency.
  const ArrayShape<Dim> shape{spectrum.count};
  std::vector<Complex> coefficients(shape.size());
  RandomStream stream(derive_seed(seed, 0x6a55));
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - stream.next_unit()));
    const double angle = 2.0 * std::numbers::pi * stream.next_unit();
    const double deviation = std::sqrt(spectrum.density[i] * spectrum.cell());
    const std::size_t mirror = mirrored(i, shape);
    if (mirror < i) {
      coefficients[i] = std::conj(coefficients[mirror]);
    } else if (mirror == i) {
      coefficients[i] = deviation * radius * std::cos(angle);
    } else {
      coefficients[i] = deviation * std::numbers::sqrt2 / 2.0 * std::polar(radius, angle);
    }
  }
  return inverse(coefficients, spectrum.count, spectrum.step);
}

Exemplar<2> compose(const ExemplarModel& model, std::span<const DenseField<2>> channels) {
  Exemplar<2> result;
  const int colors = channels.size() == 1 ? 1 : 3;
  for (int c = 0; c < colors; ++c) {
    DenseField<2>& field = result.channels.emplace_back(channels[0].count, channels[0].step);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      double value = model.mean[c];
      for (std::size_t k = 0; k < channels.size(); ++k) value += model.axes[k][c] * channels[k].values[i];
      field.values[i] = static_cast<float>(value);
    }
  }
  return model.squares ? squared(std::move(result)) : result;
}

Exemplar<2> gaussian_texture(const ExemplarModel& model, const glm::ivec2& count, const Vec<2>& step,
                             std::uint64_t seed) {
  std::vector<DenseField<2>> channels;
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    channels.push_back(
        gaussian_field(sampled_density<2>(model.channels[k], count, step), derive_seed(seed, k)));
  }
  return compose(model, channels);
}

template PowerSpectrum<2> sampled_density<2>(const GaborSpectrum&, const glm::ivec2&, const Vec<2>&);
template PowerSpectrum<3> sampled_density<3>(const GaborSpectrum&, const glm::ivec3&, const Vec<3>&);
template Exemplar<2> gaussian_version<2>(const Exemplar<2>&, std::uint64_t);
template Exemplar<3> gaussian_version<3>(const Exemplar<3>&, std::uint64_t);
template DenseField<2> gaussian_field<2>(const PowerSpectrum<2>&, std::uint64_t);
template DenseField<3> gaussian_field<3>(const PowerSpectrum<3>&, std::uint64_t);

}  // namespace solidnoise
