#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/core/image.h"

namespace solidnoise {

// A radial power spectrum to be drawn: with the bins' standard errors, and a closed form where there is one.
struct SpectrumPlot {
  std::vector<RadialBin> measured;
  std::vector<double> expected;  // per bin; empty: none
  std::string caption;           // above the plot

  SpectrumPlot() = default;
  explicit SpectrumPlot(std::vector<RadialBin> bins) : measured(std::move(bins)) {}
  // With chi-square and its significance as the caption.
  explicit SpectrumPlot(const SpectrumComparison& comparison);
};

struct FourPanelOptions {
  std::string title = {};      // above everything; may be empty
  std::string unit = "units";  // of lengths
  int width = 1000;            // of the picture, pixels; 400 to 4000
};

// The picture that shows what a noise is (as in Ling's implementation report): a slice of the noise and of
// its kernel side by side, and below each the magnitude of its two-dimensional Fourier transform, in
// logarithmic brightness with frequency 0 in the middle. Each panel has a scale bar. Below, if there are
// bins, the radial spectrum with its closed form. The noise is grey over +-2.5 of its standard deviations
// around its mean, the kernel grey over +- its largest absolute value, 0 in the middle. Both spectra show the
// same frequencies: up to 1.3 times those that hold 99.9 % of the noise's power; the noise is cut down to 50
// waves of the highest of them. Without a kernel (no values) its panels are left empty and say so. Returns
// sRGB-encoded pixels, 3 channels.
//
// Throws std::invalid_argument for a noise of under 8 samples along an axis or a width out of range.
Image draw_four_panels(const DenseField<2>& noise, const DenseField<2>& kernel,
                       const FourPanelOptions& options, const SpectrumPlot& spectrum = {});

}  // namespace solidnoise
