#include "vdbnoise/kernel_slice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"

namespace solidnoise {
namespace {

constexpr int kSide = 129;  // samples; odd, so that one is in the middle

// Samples of value(x, y) for x and y from -radius to radius.
template <typename Function>
DenseField<2> sample_square(double radius, const Function& value) {
  const double step = 2.0 * radius / (kSide - 1);
  DenseField<2> field({kSide, kSide}, {step, step});
  float* sample = field.values.data();
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      *sample++ = static_cast<float>(value(step * i - radius, step * j - radius));
    }
  }
  return field;
}

template <int Dim>
DenseField<2> slice_of(const GaborNoiseOptions& options) {
  const GaborNoise<Dim> noise(options);
  const CompactKernel& kernel = noise.compact_kernel();
  return sample_square(noise.radius(), [&](double x, double y) { return kernel.value(std::hypot(x, y)); });
}

template <int Dim>
DenseField<2> slice_of(const OrientedGaborNoiseOptions& options) {
  const OrientedGaborNoise<Dim> noise(options);
  const CompactKernel& envelope = noise.envelope();
  const Vec<Dim>& wave = noise.kernel().frequency();
  return sample_square(envelope.radius(), [&](double x, double y) {
    return envelope.value(std::abs(x)) * envelope.value(std::abs(y)) *
           std::cos(2.0 * std::numbers::pi * (wave.x * x + wave.y * y));
  });
}

template <int Dim>
DenseField<2> slice_of(const GradientNoiseOptions& options) {
  const GradientNoise<Dim> noise(options);
  const double spacing = noise.lattice_spacing()[0];
  return sample_square(GradientKernel<Dim>::kRadius * spacing, [&](double x, double y) {
    return noise.kernel().value(std::hypot(x, y) / spacing) * x / spacing;
  });
}

// Of a noise by example, the covariance in the plane: all of its kernels at once.
template <int Dim>
DenseField<2> slice_of(const SpectrumNoiseOptions& options) {
  const GaborSpectrum spectrum = options.spectrum();
  const double variance = spectrum.variance();
  double widest = spectrum.bands.front().a;
  for (const SpectrumBand& band : spectrum.bands) widest = std::min(widest, band.a);
  return sample_square(1.0 / widest, [&](double x, double y) {
    return spectrum.covariance({x, y, 0.0}) / variance;
  });
}

}  // namespace

DenseField<2> kernel_slice(const NoiseRecipe& recipe, int dims) {
  return std::visit(
      [&](const auto& options) { return dims == 3 ? slice_of<3>(options) : slice_of<4>(options); },
      recipe.noise);
}

}  // namespace solidnoise
