#include "solidnoise/noise/gabor/varying_gabor_noise.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

void VaryingGaborOptions::validate() const {
  require("frequency", frequency, kFrequencies, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_impulses(impulses);
  for (int axis = 0; axis < 4; ++axis) require("direction", direction[axis], kDirections);
}

namespace {

VaryingGaborOptions validated(const VaryingGaborOptions& options) {
  options.validate();
  return options;
}

// A direction of no length stands for the first axis.
template <int Dim>
Vec<Dim> unit_direction(const Vec<Dim>& direction) {
  const double length = glm::length(direction);
  if (length > 0.0) return direction / length;
  Vec<Dim> axis(0.0);
  axis[0] = 1.0;
  return axis;
}

template <int Dim>
Vec<Dim> first_axes(const Vec<4>& direction) {
  Vec<Dim> result;
  for (int axis = 0; axis < Dim; ++axis) result[axis] = direction[axis];
  return result;
}

}  // namespace

template <int Dim>
VaryingGaborNoise<Dim>::VaryingGaborNoise(const VaryingGaborOptions& options)
    : options_(validated(options)),
      family_(std::make_shared<KernelFamily>(Dim, options.waves, options.bandwidth, options.error)),
      kernel_(family_->at(options.bandwidth)),
      compact_(family_->compact(kernel_)) {
  const KernelMoments moments = family_->moments(kernel_);  // in units of the kernel's radius
  impulses_ = options.impulses > 0.0 ? options.impulses : impulses_for_quality(Dim, 1.0, moments);
  excess_kurtosis_ = noise_excess_kurtosis(impulse_density(Dim, impulses_, 1.0), moments);

  typename PointConvolution<Dim>::Settings settings;
  settings.waves = options.waves;
  settings.transition = options.transition;
  settings.impulses = impulses_;
  settings.seed = options.seed;
  varying_ = std::make_shared<PointConvolution<Dim>>(settings);
  settings.radius = radius(options.frequency, options.bandwidth);
  stationary_ = std::make_shared<PointConvolution<Dim>>(settings);
}

template <int Dim>
double VaryingGaborNoise<Dim>::radius(double frequency, double bandwidth) const {
  return family_->at(bandwidth).cycles / frequency;
}

template <int Dim>
void VaryingGaborNoise<Dim>::evaluate(const Points<Dim>& points, const VaryingParameters<Dim>& parameters,
                                      std::span<float> values) const {
  require_finite_positions(points);
  parameters.validate(points.size());

  const PointConvolution<Dim>& convolution = parameters.radius_varies() ? *varying_ : *stationary_;
  const Vec<Dim> constant_direction = first_axes<Dim>(options_.direction);
  const auto prepare = [&](std::span<const std::size_t> batch, std::span<KernelPoint<Dim>> kernels) {
    const PickedParameters<Dim> picked(parameters, batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      KernelPoint<Dim>& point = kernels[i];
      const double frequency = picked.frequency(i, options_.frequency);
      point.kernel = picked.varies_bandwidth() ? family_->at(picked.bandwidth(i, 0.0)) : kernel_;
      point.radius = point.kernel.cycles / frequency;
      point.amplitude = picked.magnitude(i, 1.0) / std::sqrt(convolution.power() * point.kernel.energy);
      if (options_.waves == GaborWaves::isotropic) continue;
      const Vec<Dim> direction = unit_direction<Dim>(picked.direction(i, constant_direction));
      for (int axis = 0; axis < Dim; ++axis) {
        point.wave[static_cast<std::size_t>(axis)] = frequency * direction[axis];
      }
    }
  };
  convolution.evaluate(points, prepare, values);
}

template <int Dim>
double VaryingGaborNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  const double r = kernel_.cycles / options_.frequency;
  const auto transform = [&](const Vec<Dim>& at) { return compact_.spectrum(r * glm::length(at)); };
  double spectrum = 0.0;
  if (options_.waves == GaborWaves::isotropic) {
    spectrum = transform(frequency);
  } else {
    const Vec<Dim> wave = options_.frequency * unit_direction<Dim>(first_axes<Dim>(options_.direction));
    spectrum = 0.5 * (transform(frequency - wave) + transform(frequency + wave));
  }
  return std::pow(r, Dim) * spectrum * spectrum / kernel_.energy;
}

template class VaryingGaborNoise<2>;
template class VaryingGaborNoise<3>;
template class VaryingGaborNoise<4>;

}  // namespace solidnoise
