#pragma once

#include <optional>
#include <vector>

#include "solidnoise/analysis/exemplar/color_axes.h"
#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// How much channels depend on each other in the three colour spaces (channel_dependence).
struct ColorDependence {
  double rgb = 0.0;
  double pca = 0.0;
  double independent = 0.0;
};

// The channels that an exemplar's noise is to be made of: those along the axes of a colour space, or the one
// of a gray exemplar, with the axis (1, 1, 1).
struct ExemplarChannels {
  std::vector<std::vector<double>> directions;  // for CrossSpectra::spectrum
  std::vector<double> variances;                // of the samples along them
  std::vector<Vec<3>> axes;                     // of the model
  Vec<3> mean{0.0};
  std::optional<ColorDependence> dependence;  // of exemplars in colour

  double total_variance() const;
  // Whether there is anything in a channel: the colours of an exemplar may lie in a plane.
  bool is_empty(std::size_t channel) const;
  // A spectrum that stands for a channel without anything: a millionth of a billionth of all variance.
  GaborSpectrum empty_spectrum(int dimensions, double sample_step) const;
};

template <int Dim>
ExemplarChannels exemplar_channels(const CrossSpectra<Dim>& spectra, ColorAxes axes);

extern template ExemplarChannels exemplar_channels<2>(const CrossSpectra<2>&, ColorAxes);
extern template ExemplarChannels exemplar_channels<3>(const CrossSpectra<3>&, ColorAxes);

}  // namespace solidnoise
