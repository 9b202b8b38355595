#pragma once

#include <optional>

#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/analysis/spectral_density.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The mean of the periodogram (of its average) of a stationary field with this density:
//   E P(f_k) = integral of S(f) |W(f_k - f)|^2 df,   S folded at the sampling rate,
// W the transform of the window, with unit energy. The integral over one period of the folded spectrum is
// done exactly by a sum at half the frequency step, if the field is uncorrelated over the length of a block,
// as it must be for a periodogram to make sense. Folding takes 3 images on each side, leakage 12 frequency
// steps.
template <int Dim>
PowerSpectrum<Dim> expected_periodogram(const SpectralDensity<Dim>& density, const glm::vec<Dim, int>& count,
                                        const Vec<Dim>& step, Window window = Window::hann);

// The same for a noise; `axis` as in spectral_density(). For 64^3 samples it takes about half a second.
template <int Dim>
PowerSpectrum<Dim> expected_periodogram(const Noise<Dim>& noise, const glm::vec<Dim, int>& count,
                                        const Vec<Dim>& step, Window window = Window::hann,
                                        const std::optional<Vec<Dim>>& axis = std::nullopt);

}  // namespace solidnoise
