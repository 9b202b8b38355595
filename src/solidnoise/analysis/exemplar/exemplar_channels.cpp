#include "solidnoise/analysis/exemplar/exemplar_channels.h"

#include <cstddef>

namespace solidnoise {
namespace {

constexpr double kNoVariance = 1e-15;  // of that of all channels

}  // namespace

double ExemplarChannels::total_variance() const {
  double sum = 0.0;
  for (const double variance : variances) sum += variance;
  return sum;
}

bool ExemplarChannels::is_empty(std::size_t channel) const {
  return !(variances[channel] > kNoVariance * total_variance());
}

GaborSpectrum ExemplarChannels::empty_spectrum(int dimensions, double sample_step) const {
  GaborSpectrum spectrum;
  spectrum.dimensions = dimensions;
  SpectrumComponent component;
  component.variance = kNoVariance * total_variance();
  spectrum.bands = {{0.25 / sample_step, {component}}};
  return spectrum;
}

template <int Dim>
ExemplarChannels exemplar_channels(const CrossSpectra<Dim>& spectra, ColorAxes kind) {
  ExemplarChannels result;
  if (spectra.channels == 1) {
    result.mean = Vec<3>(spectra.mean[0]);
    result.axes = {Vec<3>(1.0)};
    result.directions = {{1.0}};
  } else {
    result.mean = Vec<3>(spectra.mean[0], spectra.mean[1], spectra.mean[2]);
    const AxisMatrix axes = color_axes(spectra, kind);
    for (const Vec<3>& axis : axes) {
      result.axes.push_back(axis);
      result.directions.push_back({axis.x, axis.y, axis.z});
    }
    const auto dependence = [&](ColorAxes other) {
      return channel_dependence(spectra, color_axes(spectra, other));
    };
    result.dependence = {dependence(ColorAxes::rgb), dependence(ColorAxes::pca),
                         dependence(ColorAxes::independent)};
  }
  for (const std::vector<double>& direction : result.directions) {
    result.variances.push_back(spectra.variance(direction));
  }
  return result;
}

template ExemplarChannels exemplar_channels<2>(const CrossSpectra<2>&, ColorAxes);
template ExemplarChannels exemplar_channels<3>(const CrossSpectra<3>&, ColorAxes);

}  // namespace solidnoise
