#include "solidnoise/noise/gabor/spectrum_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/memo.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/gabor_entries.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/gabor/wave_filter.h"
#include "solidnoise/noise/kernel/compact_gradient.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {
namespace {

// Draws the waves of a band's impulses, at the time of an evolution.
template <int Dim>
class SpectrumWaveDraw {
 public:
  SpectrumWaveDraw(const SpectrumBand& band, bool isotropic, const Evolution& evolution,
                   const WaveFilter& filter)
      : frequencies_(band, isotropic), filter_(filter) {
    if (evolution.moves()) turns_.emplace(evolution);
  }

  ImpulseWave<Dim> operator()(std::uint64_t mark) const {
    RandomStream stream(mark);
    double phase = stream.next_unit();
    if (turns_) phase += turns_->at(mark);
    const Vec<Dim> wave = frequencies_(share_of(mark), stream);
    return {filter_.narrower * wave, phase - std::floor(phase), filter_.weight(glm::dot(wave, wave))};
  }

 private:
  ComponentDraw<Dim> frequencies_;
  WaveFilter filter_;
  std::optional<ImpulseTurns> turns_;
};

template <int Dim>
CompactKernel envelope_of(const SpectrumBand& band, const SpectrumNoiseOptions& options, double error) {
  return options.bounds_gradient ? compact_envelope_with_gradient(band.a, rms_frequency(band), Dim, error)
                                 : compact_envelope(band.a, Dim, error);
}

// What of a band depends on its width alone: noises follow each other that differ in its waves.
struct BandSetting {
  CompactKernel envelope;
  StrataChoice choice;
};

template <int Dim>
std::shared_ptr<const BandSetting> setting_of(const SpectrumBand& band, const SpectrumNoiseOptions& options) {
  const double slope = options.bounds_gradient ? rms_frequency(band) : 0.0;
  thread_local Memo<std::tuple<double, double, double>, BandSetting> known;
  return known.get({band.a, options.error, slope}, [&] {
    return BandSetting{envelope_of<Dim>(band, options, options.error),
                       strata_choice(RandomPhaseGaborKernel<Dim>(1.0, band.a, Vec<Dim>(0.0))).found()};
  });
}

GaborSpectrum with_variance(GaborSpectrum spectrum, double variance) {
  const double factor = variance / spectrum.variance();
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) component.variance *= factor;
  }
  return spectrum;
}

// One band, as a noise of the band's variance, or of what the filter leaves of it; its spectrum has that band
// alone.
template <int Dim>
class BandNoise final : public Noise<Dim> {
 public:
  BandNoise(const GaborSpectrum& spectrum, const CompactKernel& envelope, const ImpulseLayout<Dim>& layout,
            const SpectrumNoiseOptions& options, std::uint64_t seed)
      : spectrum_(spectrum), envelope_(envelope), variance_(spectrum.variance()), density_(layout.density) {
    // Impulses, what they draw and the amplitude are those of the noise before it is filtered.
    const SpectrumBand band = spectrum.bands.front();
    double amplitude = std::sqrt(variance_ / noise_variance(density_, wave_moments(envelope, Dim).second));
    WaveFilter filter;
    WeightMoments weights;
    if (options.filter > 0.0) {
      const double b = filter_bandwidth(options.filter);
      spectrum_ = spectrum.filtered(b);
      const FilteredShare share{std::sqrt(spectrum_.variance() / variance_),
                                band.a / spectrum_.bands.front().a};
      variance_ = 0.0;
      if (share.nothing(options.error)) return;
      filter = WaveFilter(band, b);
      weights = filter.moments(band, [](double) { return 1.0; });
      envelope_ = envelope_of<Dim>(spectrum_.bands.front(), options, share.error(options.error));
      amplitude *= filter.amplitude(Dim);
      variance_ =
          amplitude * amplitude * noise_variance(density_, wave_moments(envelope_, Dim).second, weights);
      spectrum_ = with_variance(std::move(spectrum_), variance_);
    }
    weights_ = weights;
    if (layout.count.is_fixed) cubes_ = layout.cubes();
    const double reach = envelope_.radius();
    auto kernel = std::make_shared<WaveKernel<Dim, SpectrumWaveDraw<Dim>>>(
        OrientedSum{support_scale<Dim>(layout.in_cells(reach)),
                    to_single_precision(envelope_, OrientedSum::kMostDegree), options.filter > 0.0},
        SpectrumWaveDraw<Dim>(band, spectrum_.isotropic, options.evolution, filter), layout.axes);
    convolution_ = std::make_unique<SparseConvolution<Dim>>(
        ImpulseProcess<Dim>(layout.axes, layout.count, derive_seed(seed, kImpulseStream)), kernel,
        layout.in_cells(reach), amplitude);
  }

  // Of a band of which something is left.
  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return convolution_->block(box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    convolution_->evaluate(points, samples);
  }
  const GaborSpectrum& spectrum() const { return spectrum_; }
  double variance() const override { return variance_; }
  double excess_kurtosis() const override {
    if (variance_ == 0.0) return 0.0;
    KernelMoments moments = wave_moments(envelope_, Dim);
    if (cubes_.side > 0.0) moments.overlap = wave_averages(envelope_, Dim).overlap(cubes_);
    return noise_excess_kurtosis(density_, moments, weights_);
  }

  Vec<Dim> gradient_variance() const override {
    Vec<Dim> of_waves(0.0);
    for (const SpectrumComponent& component : spectrum_.bands.front().components) {
      const Vec<Dim> w(component.frequency);
      of_waves += component.variance * (spectrum_.isotropic ? Vec<Dim>(glm::dot(w, w) / Dim) : w * w);
    }
    const double of_envelope = envelope_.gradient_energy() / envelope_.energy();
    return Vec<Dim>(variance_ * of_envelope) + 4.0 * std::numbers::pi * std::numbers::pi * of_waves;
  }

  double power_spectrum(const Vec<Dim>& frequency) const override {
    Vec<3> f(0.0);
    for (int axis = 0; axis < Dim; ++axis) f[axis] = frequency[axis];
    return spectrum_.density(f);
  }

  typename Noise<Dim>::Band band() const override {
    const auto interval = frequency_interval(spectrum_);
    return {interval.lower, interval.upper};
  }

  WaveMixture<Dim> waves() const override {
    WaveMixture<Dim> mixture;
    mixture.a = spectrum_.bands.front().a;
    mixture.impulses = density_ * std::pow(2.0 * envelope_.radius(), Dim);
    mixture.radius = envelope_.radius();
    const double share = 1.0 - std::pow(1.0 - std::pow(envelope_.relative_error(), 2), Dim);
    mixture.truncation = share * variance_;
    if (spectrum_.isotropic) mixture.symmetry = WaveMixture<Dim>::Symmetry::mirror;
    for (const SpectrumComponent& component : spectrum_.bands.front().components) {
      if (!spectrum_.isotropic) {
        mixture.waves.push_back({component.variance, Vec<Dim>(component.frequency)});
        continue;
      }
      const double frequency = glm::length(component.frequency);
      for (const auto& [direction, weight] : mirrored_directions<Dim>()) {
        mixture.waves.push_back({component.variance * weight, frequency * direction});
      }
    }
    for (const auto& wave : mixture.waves) {
      mixture.truncation_waves.push_back({share * wave.variance, wave.frequency});
    }
    return mixture;
  }

 private:
  GaborSpectrum spectrum_;  // of this band alone, filtered
  CompactKernel envelope_;  // of one axis
  double variance_;
  double density_;
  WeightMoments weights_;
  Cubes cubes_;  // of strata; of side 0 if there are none
  std::unique_ptr<const SparseConvolution<Dim>> convolution_;
};

GaborSpectrum band_of(const GaborSpectrum& spectrum, std::size_t b) {
  GaborSpectrum one = spectrum;
  one.bands = {spectrum.bands[b]};
  return one;
}

}  // namespace

GaborSpectrum SpectrumNoiseOptions::spectrum() const {
  return model.channels[static_cast<std::size_t>(channel)].scaled(frequency / model.principal_frequency());
}

GaborSpectrum SpectrumNoiseOptions::filtered_spectrum() const {
  const GaborSpectrum unfiltered = spectrum();
  if (filter == 0.0) return unfiltered;
  const GaborSpectrum left = unfiltered.filtered(filter_bandwidth(filter));
  return left.variance() > 0.0 ? left : unfiltered;
}

void SpectrumNoiseOptions::validate() const {
  if (model.channels.empty())
    throw std::invalid_argument("exemplar is missing; it must be the model of an exemplar");
  model.validate();
  require_in_range("channel", channel, 0, static_cast<double>(model.channels.size() - 1), "of the model");
  require_fields(*this);
  require_impulses(impulses);
  require_filter(filter);
  evolution.validate();
}

template <int Dim>
SpectrumNoise<Dim>::SpectrumNoise(const SpectrumNoiseOptions& options) {
  options.validate();
  const GaborSpectrum unfiltered = of_unit_variance(options.spectrum());
  spectrum_ = unfiltered;
  if (spectrum_.dimensions != Dim) {
    throw std::invalid_argument(
        fmt::format("the spectrum is of {} dimensions; it must be of {}", spectrum_.dimensions, Dim));
  }
  std::vector<std::shared_ptr<const BandSetting>> settings;
  for (const SpectrumBand& band : unfiltered.bands) {
    const StrataChoice& choice = settings.emplace_back(setting_of<Dim>(band, options))->choice;
    shares_.push_back({variance_of(band), impulses_in_ball(Dim, 1.0, choice.radius), choice});
  }
  const ImpulseBudget budget = share_impulses(shares_, options.impulses, options.impulses_process);
  if (options.impulses_process == ImpulseSpread::strata) densities_ = budget.densities;
  impulses_ = budget.impulses;
  least_density_ = HUGE_VAL;
  spectrum_.bands.clear();
  std::vector<typename FractalNoise<Dim>::Octave> bands;
  for (std::size_t b = 0; b < shares_.size(); ++b) {
    const CompactKernel& envelope = settings[b]->envelope;
    const auto layout = make_layout<Dim>(shares_[b].choice, budget.densities[b], options.impulses_process,
                                         envelope.radius(), options.period);
    auto band = std::make_unique<BandNoise<Dim>>(band_of(unfiltered, b), envelope, layout, options,
                                                 derive_seed(options.seed, kBandStream + b));
    least_density_ = std::min(least_density_, layout.density);
    if (band->variance() == 0.0) continue;  // nothing passes the filter
    spectrum_.bands.push_back(band->spectrum().bands.front());
    bands.push_back({std::move(band), 1.0});
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
