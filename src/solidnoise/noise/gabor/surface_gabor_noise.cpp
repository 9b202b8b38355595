#include "solidnoise/noise/gabor/surface_gabor_noise.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {

void SurfaceGaborOptions::validate() const {
  require("frequency", frequency, kFrequencies, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_impulses(impulses);
  require_in_range("layer", layer, 0.1, 1.0, "kernel radii");
  for (int axis = 0; axis < 3; ++axis) require("direction", direction[axis], kDirections);
  if (direction == Vec<3>(0.0)) throw std::invalid_argument("direction is 0; it must have a length");
}

namespace {

SurfaceGaborOptions validated(const SurfaceGaborOptions& options) {
  options.validate();
  return options;
}

}  // namespace

SurfaceGaborNoise::SurfaceGaborNoise(const SurfaceGaborOptions& options)
    : options_(validated(options)),
      family_(std::make_shared<KernelFamily>(2, options.waves, options.bandwidth, options.error)),
      kernel_(family_->at(options.bandwidth)),
      compact_(family_->compact(kernel_)) {
  // Moments of kernel and window, in units of the kernel's radius.
  const KernelMoments plane = family_->moments(kernel_);
  const KernelMoments moments{plane.second * layer_window_moment(2) * options.layer,
                              plane.fourth * layer_window_moment(4) * options.layer};
  const double support = 2.0 * std::numbers::pi * options.layer;
  impulses_ = options.impulses > 0.0
                  ? options.impulses
                  : std::ceil(support * density_for_excess_kurtosis(kDefaultKurtosis, moments));
  excess_kurtosis_ = noise_excess_kurtosis(impulses_ / support, moments);

  PointConvolution<3>::Settings settings{.waves = options.waves,
                                         .layer = options.layer,
                                         .transition = options.transition,
                                         .impulses = impulses_,
                                         .seed = options.seed};
  varying_ = std::make_shared<PointConvolution<3>>(settings);
  settings.radius = radius();
  stationary_ = std::make_shared<PointConvolution<3>>(settings);
}

double SurfaceGaborNoise::radius() const {
  return kernel_.cycles / options_.frequency;
}

void SurfaceGaborNoise::evaluate(const SurfacePoints& points, std::span<float> values) const {
  evaluate(points, {}, values);
}

void SurfaceGaborNoise::evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                                 std::span<float> values) const {
  points.validate();
  parameters.validate(points.positions.size());

  const PointConvolution<3>& convolution = parameters.radius_varies() ? *varying_ : *stationary_;
  const double unit_power = convolution.power() * layer_window_moment(2) * options_.layer;
  const auto prepare = [&](std::span<const std::size_t> batch, std::span<KernelPoint<3>> kernels) {
    PickedParameters<3> picked(parameters, batch);
    const auto normals = pick(points.normal, batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      KernelPoint<3>& point = kernels[i];
      const double frequency = picked.frequency(i, options_.frequency);
      point.kernel = picked.varies_bandwidth() ? family_->at(picked.bandwidth(i, 0.0)) : kernel_;
      point.radius = point.kernel.cycles / frequency;
      point.amplitude = picked.magnitude(i, 1.0) / std::sqrt(unit_power * point.kernel.energy);
      const Vec<3> normal = glm::normalize(Vec<3>(normals[0][i], normals[1][i], normals[2][i]));
      for (int axis = 0; axis < 3; ++axis) point.normal[static_cast<std::size_t>(axis)] = normal[axis];
      if (options_.waves == GaborWaves::isotropic) continue;
      const Vec<3> tangent = unit_tangent(picked.direction(i, options_.direction), normal);
      for (int axis = 0; axis < 3; ++axis) {
        point.wave[static_cast<std::size_t>(axis)] = frequency * tangent[axis];
      }
    }
  };
  convolution.evaluate(points.positions, prepare, values);
}

double SurfaceGaborNoise::power_spectrum(const Vec<2>& f) const {
  const double r = radius();
  const auto transform = [&](const Vec<2>& at) { return compact_.spectrum(r * glm::length(at)); };
  double spectrum = 0.0;
  if (options_.waves == GaborWaves::isotropic) {
    spectrum = transform(f);
  } else {
    const Vec<2> wave(options_.frequency, 0.0);
    spectrum = 0.5 * (transform(f - wave) + transform(f + wave));
  }
  return r * r * spectrum * spectrum / kernel_.energy;
}

Noise<2>::Band SurfaceGaborNoise::band() const {
  const double a = gaussian_parameter(options_.frequency, options_.bandwidth);
  const auto kernel = IsotropicGaborKernel<2>::with_unit_peak(options_.frequency, a);
  return radial_band<2>([&](double f) { return f * std::pow(kernel.spectrum(f), 2); }, options_.frequency, a);
}

}  // namespace solidnoise
