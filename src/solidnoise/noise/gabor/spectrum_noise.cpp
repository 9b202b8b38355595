#include "solidnoise/noise/gabor/spectrum_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/alias_table.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/convolution/impulse_statistics.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/directions.h"
#include "solidnoise/noise/gabor/wave_kernel.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"

namespace solidnoise {
namespace {

// Streams of the bands: one each.
constexpr std::uint64_t kBandStream = 3000;

template <int Dim>
Vec<Dim> to_dimension(const Vec<3>& vector) {
  Vec<Dim> result;
  for (int axis = 0; axis < Dim; ++axis) result[axis] = vector[axis];
  return result;
}

double variance_of(const SpectrumBand& band) {
  double sum = 0.0;
  for (const SpectrumComponent& component : band.components) sum += component.variance;
  return sum;
}

std::vector<double> variances_of(const SpectrumBand& band) {
  std::vector<double> variances;
  for (const SpectrumComponent& component : band.components) variances.push_back(component.variance);
  return variances;
}

// Draws the waves of a band's impulses, at the time of an evolution.
template <int Dim>
class ComponentDraw {
 public:
  ComponentDraw(const SpectrumBand& band, bool isotropic, const Evolution& evolution)
      : components_(std::make_shared<AliasTable>(variances_of(band))) {
    auto frequencies = std::make_shared<std::vector<Vec<Dim>>>();
    for (const SpectrumComponent& component : band.components) {
      frequencies->push_back(to_dimension<Dim>(component.frequency));
    }
    frequencies_ = std::move(frequencies);
    Vec<Dim> axis(0.0);
    axis[0] = 1.0;
    if (isotropic) directions_.emplace(axis, 0.0);
    if (evolution.moves()) turns_.emplace(evolution);
  }

  ImpulseWave<Dim> operator()(std::uint64_t mark) const {
    RandomStream stream(mark);
    double phase = stream.next_unit();
    if (turns_) phase += turns_->at(mark);
    Vec<Dim> frequency = (*frequencies_)[components_->draw(stream.next_unit())];
    if (directions_) frequency = glm::length(frequency) * directions_->draw(stream);
    return {frequency, phase - std::floor(phase)};
  }

 private:
  std::shared_ptr<const AliasTable> components_;
  std::shared_ptr<const std::vector<Vec<Dim>>> frequencies_;
  std::optional<DirectionCone<Dim>> directions_;
  std::optional<ImpulseTurns> turns_;
};

// What a band needs: its share of the variance, and its envelope.
struct BandPlan {
  const SpectrumBand* band;
  double variance;
  CompactKernel envelope;
  KernelMoments moments;
  double radius;  // that impulses per kernel refer to
};

double density_of(const BandPlan& plan, double amplitude) {
  return plan.variance / (amplitude * amplitude * plan.moments.second);
}

// One band, as a noise of the band's variance.
template <int Dim>
class BandNoise final : public Noise<Dim> {
 public:
  // `amplitude` of each kernel.
  BandNoise(BandPlan plan, bool isotropic, double amplitude, const SpectrumNoiseOptions& options,
            std::uint64_t seed)
      : plan_(std::move(plan)), band_(*plan_.band), isotropic_(isotropic) {
    plan_.band = &band_;
    const double density = density_of(plan_, amplitude);
    excess_kurtosis_ = noise_excess_kurtosis(density, plan_.moments);
    const double reach = plan_.envelope.radius();
    const auto cells = make_kernel_cells<Dim>(reach, options.period);
    auto kernel = std::make_shared<WaveKernel<Dim, ComponentDraw<Dim>>>(
        OrientedSum{support_scale<Dim>(cells.in_cells(reach)), to_single_precision(plan_.envelope)},
        ComponentDraw<Dim>(band_, isotropic, options.evolution), cells.axes);
    convolution_ = std::make_unique<SparseConvolution<Dim>>(
        ImpulseProcess<Dim>(cells.axes, density * cells.volume, derive_seed(seed, kImpulseStream)), kernel,
        cells.in_cells(reach), amplitude);
  }

  using Noise<Dim>::evaluate;
  std::unique_ptr<NoiseBlock<Dim>> block(const Box<Dim>& box) const override {
    return convolution_->block(box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    convolution_->evaluate(points, samples);
  }
  double variance() const override { return plan_.variance; }
  double excess_kurtosis() const override { return excess_kurtosis_; }

  Vec<Dim> gradient_variance() const override {
    Vec<Dim> of_waves(0.0);
    for (const SpectrumComponent& component : band_.components) {
      const Vec<Dim> w = to_dimension<Dim>(component.frequency);
      of_waves += component.variance * (isotropic_ ? Vec<Dim>(glm::dot(w, w) / Dim) : w * w);
    }
    const double of_envelope = plan_.envelope.gradient_energy() / plan_.envelope.energy();
    return Vec<Dim>(plan_.variance * of_envelope) + 4.0 * std::numbers::pi * std::numbers::pi * of_waves;
  }

  double power_spectrum(const Vec<Dim>& frequency) const override {
    Vec<3> f(0.0);
    for (int axis = 0; axis < Dim; ++axis) f[axis] = frequency[axis];
    return GaborSpectrum{Dim, isotropic_, {band_}}.density(f);
  }

  // A component's density has the deviation a / sqrt(4 pi) along each axis: a is 3.5 times that.
  typename Noise<Dim>::Band band() const override {
    double lower = HUGE_VAL;
    double upper = 0.0;
    for (const SpectrumComponent& component : band_.components) {
      if (component.variance == 0.0) continue;
      lower = std::min(lower, glm::length(component.frequency));
      upper = std::max(upper, glm::length(component.frequency));
    }
    return {std::max(0.0, lower - band_.a), upper + band_.a};
  }

 private:
  BandPlan plan_;
  SpectrumBand band_;
  bool isotropic_;
  double excess_kurtosis_ = 0.0;
  std::unique_ptr<const SparseConvolution<Dim>> convolution_;
};

template <int Dim>
std::vector<BandPlan> plan_bands(const GaborSpectrum& spectrum, double error) {
  std::vector<BandPlan> plans;
  for (const SpectrumBand& band : spectrum.bands) {
    const double variance = variance_of(band);
    if (variance == 0.0) continue;
    const CompactKernel envelope = compact_envelope(band.a, Dim, error);
    const double radius = RandomPhaseGaborKernel<Dim>(1.0, band.a, Vec<Dim>(0.0)).radius_for_error(error);
    plans.push_back({&band, variance, envelope, wave_moments(envelope, Dim), radius});
  }
  return plans;
}

GaborSpectrum of_unit_variance(GaborSpectrum spectrum) {
  const double variance = spectrum.variance();
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) component.variance /= variance;
  }
  return spectrum;
}

}  // namespace

GaborSpectrum SpectrumNoiseOptions::spectrum() const {
  return model.channels[static_cast<std::size_t>(channel)].scaled(frequency / model.principal_frequency());
}

void SpectrumNoiseOptions::validate() const {
  model.validate();
  require_in_range("channel", channel, 0, static_cast<double>(model.channels.size() - 1), "of the model");
  require_positive("frequency", frequency, "cycles per world unit");
  require_in_range("error", error, 1e-4, 0.5, "relative RMS error");
  require_in_range("impulses", impulses, 0.0, 100000.0, "mean impulses per kernel; 0 chooses");
  for (int axis = 0; axis < 4; ++axis) {
    require_at_least("period", period[axis], 0.0, "world units; 0 for none");
  }
  evolution.validate();
}

template <int Dim>
SpectrumNoise<Dim>::SpectrumNoise(const SpectrumNoiseOptions& options) {
  options.validate();
  spectrum_ = of_unit_variance(options.spectrum());
  if (spectrum_.dimensions != Dim) {
    throw std::invalid_argument(
        fmt::format("the spectrum is of {} dimensions; it must be of {}", spectrum_.dimensions, Dim));
  }
  const std::vector<BandPlan> plans = plan_bands<Dim>(spectrum_, options.error);

  // With kernels of amplitude A in all bands the density of a band is variance_b / (A^2 M_b), M_b the
  // kernel's second moment: the number of impulses goes with 1 / A^2, the excess kurtosis with A^2.
  double impulses = 0.0;
  double kurtosis = 0.0;
  for (const BandPlan& plan : plans) {
    impulses += impulses_in_ball(Dim, plan.variance / plan.moments.second, plan.radius);
    kurtosis += plan.variance * plan.moments.fourth / plan.moments.second;
  }
  impulses_ = options.impulses > 0.0 ? options.impulses : std::ceil(impulses * kurtosis / kDefaultKurtosis);
  amplitude_ = std::sqrt(impulses / impulses_);

  least_density_ = HUGE_VAL;
  for (const BandPlan& plan : plans) {
    least_density_ = std::min(least_density_, density_of(plan, amplitude_));
  }

  std::vector<typename FractalNoise<Dim>::Octave> bands;
  for (std::size_t b = 0; b < plans.size(); ++b) {
    const std::uint64_t seed = derive_seed(options.seed, kBandStream + b);
    bands.push_back(
        {std::make_unique<BandNoise<Dim>>(plans[b], spectrum_.isotropic, amplitude_, options, seed), 1.0});
  }
  bands_ = std::make_unique<FractalNoise<Dim>>(std::move(bands));
}

template <int Dim>
double SpectrumNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  return bands_->power_spectrum(frequency);
}

template class SpectrumNoise<2>;
template class SpectrumNoise<3>;

}  // namespace solidnoise
