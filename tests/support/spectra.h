#pragma once

#include <algorithm>
#include <cstdint>

#include "solidnoise/noise/gabor/spectrum_noise.h"

namespace solidnoise {

// A mixture of two bands and four components around frequency 1, in 2 or 3 dimensions.
inline SpectrumNoiseOptions some_spectrum(int dimensions, bool isotropic = false) {
  const double z = dimensions == 3 ? 0.4 : 0.0;
  GaborSpectrum spectrum;
  spectrum.dimensions = dimensions;
  spectrum.isotropic = isotropic;
  spectrum.bands = {{0.4, {{{0.9, 0.3, z}, 0.3}, {{-0.2, 1.1, 0.0}, 0.2}, {{0.0, 0.0, 0.0}, 0.15}}},
                    {0.8, {{{0.7, -0.8, -z}, 0.35}}}};
  SpectrumNoiseOptions options;
  options.model.channels = {spectrum};
  options.frequency = options.model.principal_frequency();
  options.impulses = 60.0;
  return options;
}

// How far the noise's kernels reach, at most: three times the radius of the widest envelope's 1 / a.
inline double support_of(const SpectrumNoiseOptions& options) {
  double least = options.spectrum().bands.front().a;
  for (const SpectrumBand& band : options.spectrum().bands) least = std::min(least, band.a);
  return 3.0 / least;
}

}  // namespace solidnoise
