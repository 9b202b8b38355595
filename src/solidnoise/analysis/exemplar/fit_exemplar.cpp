#include "solidnoise/analysis/exemplar/fit_exemplar.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/group_spectrum.h"

namespace solidnoise {
namespace {

constexpr double kLargestKappa = 0.25;  // of a weak channel
constexpr double kNoVariance = 1e-15;   // of that of all channels

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

// What stands for a channel that the exemplar does not have.
template <int Dim>
SpectrumFit empty_channel(const PowerSpectrum<Dim>& periodogram, double variance) {
  SpectrumFit fit;
  fit.spectrum.dimensions = Dim;
  fit.spectrum.bands = {{0.25 / periodogram.step[0], {{Vec<3>(0.0), variance}}}};
  fit.components = 1;
  return fit;
}

}  // namespace

void ExemplarFitOptions::validate() const {
  spectrum.validate();
}

template <int Dim>
ExemplarFit<Dim> fit_exemplar(std::span<const Exemplar<Dim>> exemplars, const ExemplarFitOptions& options,
                              Progress* progress) {
  options.validate();
  const CrossSpectra<Dim> spectra = cross_spectra(exemplars, options.patch);
  ExemplarFit<Dim> result;
  result.count = spectra.count;
  result.patches = spectra.patches;
  result.model.raw_values = options.raw_values;
  for (int i = 0; i < 3; ++i) {
    result.model.mean[i] = spectra.mean[static_cast<std::size_t>(spectra.channels == 1 ? 0 : i)];
  }
  std::vector<std::vector<double>> directions{{1.0}};
  if (spectra.channels == 3) {
    const AxisMatrix axes = color_axes(spectra, options.axes);
    result.model.axes.assign(axes.begin(), axes.end());
    directions.clear();
    for (const Vec<3>& axis : axes) directions.push_back({axis.x, axis.y, axis.z});
    const auto dependence = [&](ColorAxes kind) {
      return channel_dependence(spectra, color_axes(spectra, kind));
    };
    result.dependence = {dependence(ColorAxes::rgb), dependence(ColorAxes::pca),
                         dependence(ColorAxes::independent)};
  }

  double total = 0.0;
  double strongest = 0.0;
  for (const std::vector<double>& direction : directions) {
    total += spectra.variance(direction);
    strongest = std::max(strongest, spectra.variance(direction));
  }
  result.channels.resize(directions.size());
  SharedProgress shared(progress, directions.size());
  tbb::parallel_for(std::size_t(0), directions.size(), [&](std::size_t k) {
    const PowerSpectrum<Dim> periodogram = spectra.spectrum(directions[k]);
    const double variance = spectra.variance(directions[k]);
    SpectrumFitOptions channel = options.spectrum;
    if (options.weigh_channels) {
      const double weighted = channel.kappa * std::sqrt(strongest / variance);
      channel.kappa = std::max(channel.kappa, std::min(kLargestKappa, weighted));
    }
    SharedProgress::Channel storage;
    result.channels[k] = variance > kNoVariance * total && periodogram.variance() > kNoVariance * total
                             ? fit_channel(periodogram, variance, channel, shared.channel(k, storage))
                             : empty_channel(periodogram, kNoVariance * total);
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
