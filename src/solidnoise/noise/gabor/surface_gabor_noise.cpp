#include "solidnoise/noise/gabor/surface_gabor_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/impulse_strata.h"

namespace solidnoise {

void SurfaceGaborOptions::validate() const {
  require("frequency", frequency, kFrequencies, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_impulses(impulses);
  require("kurtosis", kurtosis, kKurtosis);
  require_in_range("layer", layer, 0.1, 1.0, "kernel radii");
  for (int axis = 0; axis < 3; ++axis) require("direction", direction[axis], kDirections);
  if (direction == Vec<3>(0.0)) throw std::invalid_argument("direction is 0; it must have a length");
  evolution.validate();
  require_positive("unit", unit, "world units");
  require_in_range("filter", filter, 0.0, 1e9, "world units");
}

namespace {

SurfaceGaborOptions validated(const SurfaceGaborOptions& options) {
  options.validate();
  return options;
}

// A length of 1, as far as single precision tells, is 1. Waves are at most a thousand times longer.
double coherence_of(const Vec<3>& direction) {
  const double length = glm::length(direction);
  return length > 0.9999 ? 1.0 : std::max(length, 1e-3);
}

StrataChoice surface_choice(const SurfaceGaborOptions& options, double half_thickness) {
  const double a = gaussian_parameter(options.frequency, options.bandwidth);
  if (options.waves == GaborWaves::oriented) {
    return layer_strata_choice(EvenGaborKernel<2>(a, options.frequency), half_thickness, layer_window);
  }
  return layer_strata_choice(IsotropicGaborKernel<2>::with_unit_peak(options.frequency, a), half_thickness,
                             layer_window);
}

}  // namespace

SurfaceGaborNoise::SurfaceGaborNoise(const SurfaceGaborOptions& options)
    : options_(validated(options)),
      family_(std::make_shared<KernelFamily>(2, options.waves, options.bandwidth, options.error,
                                             options.bounds_gradient)),
      kernel_(family_->at(options.bandwidth)) {
  if (options.filter > 0.0)
    filtered_ = family_->filtered(options.frequency, options.bandwidth, options.filter);
  const double r = radius();
  const double nominal = family_->nominal_share() * r;
  choice_ = surface_choice(options, options.layer * nominal);
  choice_.kurtosis = options.kurtosis;
  if (options.evolution.moves()) choice_.weights = turning({});
  support_ = 2.0 * std::numbers::pi * options.layer * std::pow(nominal, 3);
  // Of the kernels as they are evaluated, and their window.
  const KernelMoments plane = family_->moments(kernel_);
  KernelMoments moments{plane.second * r * r * layer_window_moment(2) * options.layer * nominal,
                        plane.fourth * r * r * layer_window_moment(4) * options.layer * nominal};
  const double wanted = options.impulses / support_;
  const auto layout = make_layout<3>(choice_, wanted, options.impulses_process, r, Vec<4>(0.0));
  impulses_ = layout.density * support_;
  const bool fixed = layout.count.is_fixed;
  density_ = layout.density;
  if (fixed) cubes_ = layout.cubes();
  scales_ = scale_layout(choice_, wanted, options.impulses_process);
  scale_in_radii_ = scales_.scale / r;

  PointConvolution<3>::Settings settings{.waves = options.waves,
                                         .layer = options.layer * family_->nominal_share(),
                                         .count = scales_.count,
                                         .unit = options.unit,
                                         .seed = options.seed};
  if (options.evolution.moves()) settings.factor = TurningFactor(options.evolution);
  varying_ = std::make_shared<PointConvolution<3>>(settings);
  varying_excess_kurtosis_ = scales_.excess_kurtosis(choice_, moments);
  if (fixed) {
    moments.overlap =
        choice_.averages->overlap(layout.cubes()) * std::pow(moments.second / choice_.moments.second, 2);
  }
  excess_kurtosis_ = noise_excess_kurtosis(layout.density, moments, choice_.weights);
  settings.side = layout.cell_side();
  settings.count = layout.count;
  stationary_ = std::make_shared<PointConvolution<3>>(settings);
}

double SurfaceGaborNoise::kurtosis_given_place() const {
  return cubes_.side > 0.0
             ? solidnoise::kurtosis_given_place(density_, choice_.moments, *choice_.averages, cubes_)
             : 0.0;
}

double SurfaceGaborNoise::radius() const {
  return kernel_.cycles / options_.frequency;
}

void SurfaceGaborNoise::evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                                 const Samples<3>& samples) const {
  points.validate();
  parameters.validate(points.positions.size());

  const bool varies = parameters.radius_varies();
  const PointConvolution<3>& convolution = varies ? *varying_ : *stationary_;
  const double thickness = layer_window_moment(2) * options_.layer * family_->nominal_share();  // in radii
  const bool oriented = options_.waves == GaborWaves::oriented;
  const Vec<3> constant_direction = glm::normalize(options_.direction);
  const auto prepare = [&](std::span<const std::size_t> batch, std::span<KernelPoint<3>> kernels) {
    PickedParameters<3> picked(parameters, batch);
    const auto normals = pick(points.normal, batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      KernelPoint<3>& point = kernels[i];
      const double frequency = picked.frequency(i, options_.frequency);
      const double bandwidth = picked.bandwidth(i, options_.bandwidth);
      const Vec<3> direction = picked.direction(i, constant_direction);
      const double coherence = oriented ? coherence_of(direction) : 1.0;
      point.kernel =
          picked.varies_bandwidth() || coherence < 1.0 ? family_->at(bandwidth, coherence) : kernel_;
      point.radius = family_->cycles(bandwidth) / frequency;
      point.scale = scale_in_radii_ * point.radius;
      const double extent = varies ? point.radius / point.scale : point.radius;
      const double power = convolution.power() * thickness * std::pow(extent, 3);
      point.amplitude = picked.magnitude(i, 1.0) / std::sqrt(power * point.kernel.energy);
      const Vec<3> normal = glm::normalize(Vec<3>(normals[0][i], normals[1][i], normals[2][i]));
      for (int axis = 0; axis < 3; ++axis) point.normal[static_cast<std::size_t>(axis)] = normal[axis];
      if (oriented) {
        const Vec<3> tangent = unit_tangent(direction, normal);
        for (int axis = 0; axis < 3; ++axis) {
          point.wave[static_cast<std::size_t>(axis)] = coherence * frequency * tangent[axis];
        }
      }
      if (!filtered_) continue;
      const bool own = varies || coherence < 1.0;
      filter_kernel(point,
                    own ? family_->filtered(frequency, bandwidth, options_.filter, coherence) : *filtered_,
                    coherence * frequency);
    }
  };
  convolution.evaluate(points.positions, prepare, samples);
}

Noise<2>::Band SurfaceGaborNoise::band() const {
  const double a = gaussian_parameter(options_.frequency, options_.bandwidth);
  const auto kernel = IsotropicGaborKernel<2>::with_unit_peak(options_.frequency, a);
  return radial_band<2>([&](double f) { return f * std::pow(kernel.spectrum(f), 2); }, options_.frequency, a);
}

}  // namespace solidnoise
