#include "solidnoise/analysis/exemplar/fit_exemplar.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/channel_spectra.h"
#include "solidnoise/analysis/exemplar/edit_spectrum.h"
#include "solidnoise/analysis/exemplar/frequency_rings.h"
#include "solidnoise/analysis/exemplar/match_rings.h"
#include "solidnoise/analysis/exemplar/square_colors.h"

namespace solidnoise {
namespace {

constexpr double kLargestKappa = 1.0 / 64.0;  // of a weak channel

// The channels' progress as that of one task.
class SharedProgress {
 public:
  SharedProgress(Progress* whole, std::size_t channels) : whole_(whole), done_(channels) {}

  struct Channel final : Progress {
    SharedProgress* shared = nullptr;
    std::size_t index = 0;

    void advance(std::uint64_t done, std::uint64_t total) override {
      shared->done_[index] = done;
      std::uint64_t sum = 0;
      for (const std::atomic<std::uint64_t>& each : shared->done_) sum += each;
      shared->whole_->advance(sum, total * shared->done_.size());
    }
    bool cancelled() override { return shared->whole_->cancelled(); }
  };

  // Null if nobody wants to know.
  Progress* channel(std::size_t index, Channel& storage) {
    if (whole_ == nullptr) return nullptr;
    storage.shared = this;
    storage.index = index;
    return &storage;
  }

 private:
  Progress* whole_;
  std::vector<std::atomic<std::uint64_t>> done_;
};

// A channel that was stopped before it had anything is given the first, coarse solution.
template <int Dim>
SpectrumFit fit_channel(const PowerSpectrum<Dim>& periodogram, double variance,
                        const SpectrumFitOptions& options, Progress* progress) {
  try {
    return fit_spectrum(periodogram, variance, options, progress);
  } catch (const Cancelled&) {
    SpectrumFitOptions coarse = options;
    coarse.kappa = std::max(options.kappa, 0.5);
    SpectrumFit fit = fit_spectrum(periodogram, variance, coarse);
    fit.interrupted = true;
    return fit;
  }
}

}  // namespace

void ExemplarFitOptions::validate() const {
  spectrum.validate();
}

template <int Dim>
ExemplarFit<Dim> fit_exemplar(std::span<const Exemplar<Dim>> exemplars, const ExemplarFitOptions& options,
                              Progress* progress) {
  options.validate();
  if (options.squares) {
    ExemplarFitOptions of_roots = options;
    of_roots.squares = false;
    ExemplarFit<Dim> fit = fit_exemplar<Dim>(square_roots(exemplars), of_roots, progress);
    square_colors(fit.model, sample_moments(exemplars));
    return fit;
  }
  const CrossSpectra<Dim> spectra = cross_spectra(exemplars, options.patch, progress);
  ExemplarFit<Dim> result;
  result.count = spectra.count;
  result.patches = spectra.patches;
  result.model.raw_values = options.raw_values;
  const ExemplarChannels channels = exemplar_channels(spectra, options.axes);
  result.model.mean = channels.mean;
  result.model.axes = channels.axes;
  result.dependence = channels.dependence;

  const std::vector<PowerSpectrum<Dim>> periodograms = channel_spectra(spectra, channels);
  FrequencyRings rings;
  const bool matches_rings = Dim == 2 && options.spectrum.fill;
  if constexpr (Dim == 2) {
    if (matches_rings) rings = frequency_rings(exemplars, channels, progress);
  }
  const double strongest = *std::max_element(channels.variances.begin(), channels.variances.end());
  result.channels.resize(channels.axes.size());
  SharedProgress shared(progress, result.channels.size());
  tbb::parallel_for(std::size_t(0), result.channels.size(), [&](std::size_t k) {
    // Of colours that differ by a slope alone, which periodic components are without, nothing may be left.
    const PowerSpectrum<Dim> periodogram =
        periodograms[k].variance() > 0.0 ? periodograms[k] : spectra.spectrum(channels.directions[k]);
    if (channels.is_empty(k) || !(periodogram.variance() > 0.0)) {
      result.channels[k].spectrum = channels.empty_spectrum(Dim, periodogram.step[0]);
      return;
    }
    SpectrumFitOptions channel = options.spectrum;
    if (options.weigh_channels) {
      const double weighted = channel.kappa * std::sqrt(strongest / channels.variances[k]);
      channel.kappa = std::max(channel.kappa, std::min(kLargestKappa, weighted));
    }
    SharedProgress::Channel storage;
    // The variance of the samples, of which the periodic component has lost some.
    result.channels[k] = fit_channel(periodogram, channels.variances[k], channel, shared.channel(k, storage));
    if (matches_rings) match_rings(result.channels[k].spectrum, rings, k);
  });
  for (const SpectrumFit& fit : result.channels) {
    result.model.channels.push_back(group_spectrum(fit.spectrum));
    result.interrupted = result.interrupted || fit.interrupted;
  }
  result.model.validate();
  return result;
}

template ExemplarFit<2> fit_exemplar<2>(std::span<const Exemplar<2>>, const ExemplarFitOptions&, Progress*);
template ExemplarFit<3> fit_exemplar<3>(std::span<const Exemplar<3>>, const ExemplarFitOptions&, Progress*);

}  // namespace solidnoise
