#pragma once

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The power spectrum of a section of a noise (the projection-slice theorem): that of the noise, integrated
// over the frequencies across the section; `at(f)` is the one that is f across it. Part by part, each over
// its own band: an octave's may be a thousandth of the whole's.
template <int Dim, typename At>
double section_spectrum(const Noise<Dim>& noise, const At& at) {
  constexpr int kPanels = 16;
  if (const auto parts = noise.parts(); !parts.empty()) {
    double sum = 0.0;
    for (const auto& part : parts) sum += part.amplitude * part.amplitude * section_spectrum(*part.noise, at);
    return sum;
  }
  const double highest = 1.25 * noise.band().upper;
  return integrate([&](double f) { return noise.power_spectrum(at(f)); }, -highest, highest, kPanels);
}

}  // namespace solidnoise
