#include "solidnoise/noise/gabor/oriented_gabor_noise.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/kernel/compact_gradient.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {
namespace {

template <int Dim>
DirectionCone<Dim> make_directions(const OrientedGaborNoiseOptions& options) {
  options.validate();
  Vec<Dim> axis(0.0);
  for (int i = 0; i < Dim; ++i) axis[i] = options.direction[i];
  if (glm::length(axis) == 0.0) {
    throw std::invalid_argument("direction has no component along the axes of this noise");
  }
  return {axis, options.anisotropy};
}

template <int Dim>
CompactKernel fit_envelope(double a, double frequency, double error, bool bounds_gradient) {
  return bounds_gradient ? compact_envelope_with_gradient(a, frequency, Dim, error)
                         : compact_envelope(a, Dim, error);
}

// Draws the waves of impulses, at the time of an evolution.
template <int Dim>
class WaveDraw {
 public:
  WaveDraw(const DirectionCone<Dim>& directions, double frequency, const Evolution& evolution,
           double phase_shift)
      : directions_(directions), frequency_(frequency), phase_shift_(phase_shift) {
    if (evolution.moves()) turns_.emplace(evolution);
  }

  ImpulseWave<Dim> operator()(std::uint64_t mark) const {
    RandomStream stream(mark);
    double phase = stream.next_unit();
    if (turns_) phase += turns_->at(mark);
    phase += phase_shift_;
    return {frequency_ * directions_.draw(share_of(mark), stream), phase - std::floor(phase)};
  }

 private:
  DirectionCone<Dim> directions_;
  double frequency_;
  double phase_shift_;  // cycles
  std::optional<ImpulseTurns> turns_;
};

// Mean of the kernel's power spectrum over the cone of directions d: in closed form over the turns around the
// cone's axis, by quadrature over the polar angle p. With f split into f_1 along the axis and f_2 across,
//   |f - F d|^2 = (f_1 - F cos p)^2 + (f_2 - F sin p)^2 + 2 f_2 F sin p (1 - u),
// where u is a coordinate of a uniform direction in Dim - 1 dimensions.
template <int Dim>
double mean_over_cone(const RandomPhaseGaborKernel<Dim>& kernel, const DirectionCone<Dim>& directions,
                      const Vec<Dim>& f) {
  const double frequency = glm::length(kernel.frequency());
  const double sharpness = 2.0 * std::numbers::pi / (kernel.a() * kernel.a());
  const double along = glm::dot(f, directions.axis());
  const double across = glm::length(f - along * directions.axis());
  const auto edge = directions.polar_angle(1.0);
  const double widest = std::atan2(edge.sine, edge.cosine);
  const int panels = static_cast<int>(std::ceil(0.5 * frequency / kernel.a()));
  const double area =
      integrate([](double angle) { return std::pow(std::sin(angle), Dim - 2); }, 0.0, widest, panels);
  const double total = integrate(
      [&](double angle) {
        const double sine = std::sin(angle);
        const double cosine = std::cos(angle);
        const double width = across - frequency * sine;
        const double around = mean_exponential_scaled(Dim - 1, 2.0 * sharpness * across * frequency * sine);
        double sum = 0.0;
        for (const double side : {along, -along}) {
          const double height = side - frequency * cosine;
          sum += std::exp(-sharpness * (height * height + width * width)) * around;
        }
        return sum * std::pow(sine, Dim - 2);
      },
      0.0, widest, panels);
  return 0.25 * kernel.amplitude() * kernel.amplitude() * std::pow(kernel.a(), -2 * Dim) * total / area;
}

}  // namespace

template <int Dim>
OrientedGaborNoise<Dim>::OrientedGaborNoise(const OrientedGaborNoiseOptions& options, double phase_shift)
    : options_(options),
      phase_shift_(phase_shift),
      directions_(make_directions<Dim>(options)),
      kernel_(1.0, gaussian_parameter(options.frequency, options.bandwidth),
              options.frequency * directions_.axis()),
      frequency_(options.frequency),
      envelope_(fit_envelope<Dim>(kernel_.a(), frequency_, options.error, options.bounds_gradient)),
      radius_(kernel_.radius_for_error(options.error)) {
  const KernelMoments moments = wave_moments(envelope_, Dim);
  // Impulses and amplitude are those of the noise before it is filtered, impulses those of unlimited kernels.
  StrataChoice choice = strata_choice(kernel_);
  choice.kurtosis = options.kurtosis;
  const ImpulseLayout<Dim> layout =
      make_layout<Dim>(choice, solidnoise::impulse_density(Dim, options.impulses, choice.radius),
                       options.impulses_process, envelope_.radius(), options.period);
  density_ = layout.density;
  impulses_ = impulses_in_ball(Dim, density_, choice.radius);
  const double amplitude = 1.0 / std::sqrt(noise_variance(density_, moments.second));
  std::shared_ptr<const ImpulseKernel> kernel;
  if (options.filter == 0.0 || filter_kernel()) {
    KernelMoments filtered = wave_moments(envelope_, Dim);
    variance_ = std::pow(kernel_.amplitude(), 2) * filtered.second / moments.second;
    if (layout.count.is_fixed) {
      const ProductAverages cubes = wave_averages(envelope_, Dim);
      filtered.overlap = cubes.overlap(layout.cubes());
      kurtosis_given_place_ = solidnoise::kurtosis_given_place(density_, filtered, cubes, layout.cubes());
    }
    excess_kurtosis_ = noise_excess_kurtosis(density_, filtered);
    kernel = std::make_shared<WaveKernel<Dim, WaveDraw<Dim>>>(
        OrientedSum{support_scale<Dim>(layout.in_cells(envelope_.radius())),
                    to_single_precision(envelope_, OrientedSum::kMostDegree)},
        WaveDraw<Dim>(directions_, frequency_, options.evolution, phase_shift), layout.axes);
  }
  convolution_ = std::make_shared<SparseConvolution<Dim>>(
      ImpulseProcess<Dim>(layout.axes, layout.count, derive_seed(options.seed, kImpulseStream)), kernel,
      layout.in_cells(envelope_.radius()), kernel_.amplitude() * amplitude);
}

// Puts the filtered kernel in the place of the kernel; false, and no change, if nothing is left of it.
template <int Dim>
bool OrientedGaborNoise<Dim>::filter_kernel() {
  const RandomPhaseGaborKernel<Dim> filtered = kernel_.filtered(filter_bandwidth(options_.filter));
  const FilteredShare share{std::sqrt(filtered.energy() / kernel_.energy()), kernel_.a() / filtered.a()};
  if (share.nothing(options_.error)) return false;
  kernel_ = filtered;
  frequency_ = glm::length(filtered.frequency());
  envelope_ =
      fit_envelope<Dim>(filtered.a(), frequency_, share.error(options_.error), options_.bounds_gradient);
  radius_ = filtered.radius_for_error(share.error(options_.error));
  return true;
}

template <int Dim>
ImpulseWave<Dim> OrientedGaborNoise<Dim>::wave(std::uint64_t mark) const {
  return WaveDraw<Dim>(directions_, frequency_, options_.evolution, phase_shift_)(mark);
}

// The derivative of envelope times wave, squared and averaged over the phase: that of the envelope and that
// of the wave each add half of theirs.
template <int Dim>
Vec<Dim> OrientedGaborNoise<Dim>::gradient_variance() const {
  const double wave_number = 2.0 * std::numbers::pi * frequency_;
  const double of_envelope = envelope_.gradient_energy() / envelope_.energy();
  return variance() * (of_envelope + wave_number * wave_number * directions_.second_moments());
}

template <int Dim>
double OrientedGaborNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  if (variance_ == 0.0) return 0.0;
  if constexpr (Dim > 1) {
    if (options_.anisotropy == 0.0) {
      return variance_ * kernel_.isotropic_power_spectrum(glm::length(frequency)) / kernel_.energy();
    }
    if (options_.anisotropy < 1.0) {
      return variance_ * mean_over_cone<Dim>(kernel_, directions_, frequency) / kernel_.energy();
    }
  }
  // A pair of products of the envelope's transforms; per axis the envelope is exact.
  double sum = 0.0;
  for (const double sign : {1.0, -1.0}) {
    double product = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      const double spectrum =
          envelope_.spectrum(std::abs(frequency[axis] - sign * kernel_.frequency()[axis]));
      product *= spectrum * spectrum / envelope_.energy();
    }
    sum += 0.5 * variance_ * product;
  }
  return sum;
}

template <int Dim>
typename Noise<Dim>::Band OrientedGaborNoise<Dim>::band() const {
  if (variance_ == 0.0) return {};
  const auto density = [this](double f) {
    return std::pow(f, Dim - 1) * kernel_.isotropic_power_spectrum(f);
  };
  return radial_band<Dim>(density, frequency_, kernel_.a());
}

// The waves of the cone's directions, under the envelope.
template <int Dim>
WaveMixture<Dim> OrientedGaborNoise<Dim>::waves() const {
  WaveMixture<Dim> mixture;
  if (variance_ == 0.0) return mixture;
  mixture.a = kernel_.a();
  mixture.impulses = impulses_in_ball(Dim, density_, radius_);
  mixture.radius = envelope_.radius();
  mixture.truncation = variance_ * (1.0 - std::pow(1.0 - std::pow(envelope_.relative_error(), 2), Dim));
  if (Dim > 1 && options_.anisotropy == 0.0) mixture.symmetry = WaveMixture<Dim>::Symmetry::mirror;
  for (const auto& [direction, weight] : directions_.quadrature()) {
    mixture.waves.push_back({variance_ * weight, frequency_ * direction});
    mixture.truncation_waves.push_back({mixture.truncation * weight, frequency_ * direction});
  }
  return mixture;
}

template class OrientedGaborNoise<1>;
template class OrientedGaborNoise<2>;
template class OrientedGaborNoise<3>;
template class OrientedGaborNoise<4>;

}  // namespace solidnoise
