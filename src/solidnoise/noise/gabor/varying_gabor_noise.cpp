#include "solidnoise/noise/gabor/varying_gabor_noise.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/impulse_strata.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/point/scale_layout.h"

namespace solidnoise {

void VaryingGaborOptions::validate() const {
  require("frequency", frequency, kFrequencies, "cycles per world unit");
  require_in_range("bandwidth", bandwidth, KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                   "octaves");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_impulses(impulses);
  require("kurtosis", kurtosis, kKurtosis);
  for (int axis = 0; axis < 4; ++axis) require("direction", direction[axis], kDirections);
  evolution.validate();
  require_positive("unit", unit, "world units");
  require_in_range("filter", filter, 0.0, 1e9, "world units");
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

template <int Dim>
StrataChoice varying_choice(const VaryingGaborOptions& options) {
  const double a = gaussian_parameter(options.frequency, options.bandwidth);
  if (options.waves == GaborWaves::oriented) {
    return strata_choice(EvenGaborKernel<Dim>(a, options.frequency));
  }
  return strata_choice(IsotropicGaborKernel<Dim>::with_unit_peak(options.frequency, a), {});
}

}  // namespace

template <int Dim>
VaryingGaborNoise<Dim>::VaryingGaborNoise(const VaryingGaborOptions& options)
    : options_(validated(options)),
      family_(std::make_shared<KernelFamily>(Dim, options.waves, options.bandwidth, options.error,
                                             options.bounds_gradient)),
      kernel_(family_->at(options.bandwidth)) {
  if (options.filter > 0.0)
    filtered_ = family_->filtered(options.frequency, options.bandwidth, options.filter);
  const double r = radius(options.frequency, options.bandwidth);
  StrataChoice choice = varying_choice<Dim>(options);
  choice.kurtosis = options.kurtosis;
  if (options.evolution.moves()) choice.weights = turning({});
  const double wanted = impulse_density(Dim, options.impulses, choice.radius);
  const auto layout = make_layout<Dim>(choice, wanted, options.impulses_process, r, Vec<4>(0.0));
  impulses_ = impulses_in_ball(Dim, layout.density, choice.radius);
  KernelMoments moments = family_->moments(kernel_);
  moments.second *= std::pow(r, Dim);
  moments.fourth *= std::pow(r, Dim);
  const ScaleLayout scales = scale_layout(choice, wanted, options.impulses_process);
  scale_in_radii_ = scales.scale / r;

  typename PointConvolution<Dim>::Settings settings;
  settings.waves = options.waves;
  settings.seed = options.seed;
  settings.unit = options.unit;
  if (options.evolution.moves()) settings.factor = TurningFactor(options.evolution);
  settings.count = scales.count;
  varying_ = std::make_shared<PointConvolution<Dim>>(settings);
  varying_excess_kurtosis_ = scales.excess_kurtosis(choice, moments);
  if (layout.count.is_fixed) {
    moments.overlap =
        choice.averages->overlap(layout.cubes()) * std::pow(moments.second / choice.moments.second, 2);
  }
  excess_kurtosis_ = noise_excess_kurtosis(layout.density, moments, choice.weights);
  settings.side = layout.cell_side();
  settings.count = layout.count;
  stationary_ = std::make_shared<PointConvolution<Dim>>(settings);
}

template <int Dim>
double VaryingGaborNoise<Dim>::radius(double frequency, double bandwidth) const {
  return family_->at(bandwidth).cycles / frequency;
}

template <int Dim>
void VaryingGaborNoise<Dim>::evaluate(const Points<Dim>& points, const VaryingParameters<Dim>& parameters,
                                      const Samples<Dim>& samples) const {
  require_finite_positions(points);
  parameters.validate(points.size());

  const bool varies = parameters.radius_varies();
  const PointConvolution<Dim>& convolution = varies ? *varying_ : *stationary_;
  const Vec<Dim> constant_direction = first_axes<Dim>(options_.direction);
  const auto prepare = [&](std::span<const std::size_t> batch, std::span<KernelPoint<Dim>> kernels) {
    const PickedParameters<Dim> picked(parameters, batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      KernelPoint<Dim>& point = kernels[i];
      const double frequency = picked.frequency(i, options_.frequency);
      point.kernel = picked.varies_bandwidth() ? family_->at(picked.bandwidth(i, 0.0)) : kernel_;
      point.radius = point.kernel.cycles / frequency;
      point.scale = scale_in_radii_ * point.radius;
      const double extent = varies ? point.radius / point.scale : point.radius;
      const double power = convolution.power() * std::pow(extent, Dim);
      point.amplitude = picked.magnitude(i, 1.0) / std::sqrt(power * point.kernel.energy);
      if (options_.waves == GaborWaves::oriented) {
        const Vec<Dim> direction = unit_direction<Dim>(picked.direction(i, constant_direction));
        for (int axis = 0; axis < Dim; ++axis) {
          point.wave[static_cast<std::size_t>(axis)] = frequency * direction[axis];
        }
      }
      if (!filtered_) continue;
      const double bandwidth = picked.bandwidth(i, options_.bandwidth);
      filter_kernel(point, varies ? family_->filtered(frequency, bandwidth, options_.filter) : *filtered_,
                    frequency);
    }
  };
  convolution.evaluate(points, prepare, samples);
}

template class VaryingGaborNoise<3>;
template class VaryingGaborNoise<4>;

}  // namespace solidnoise
