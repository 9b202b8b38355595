#pragma once

#include <functional>
#include <optional>

#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A two-sided power spectral density in closed form.
template <int Dim>
struct SpectralDensity {
  std::function<double(const Vec<Dim>&)> density;  // at a frequency in cycles per unit; even
  double reach = 0.0;                              // taken as 0 beyond this |frequency|; > 0
};

// The noise's power_spectrum(), made fast to evaluate very often; the noise must outlive the result. Where it
// depends on |f| alone it is tabulated, finely enough for blocks of `block_length` world units (the longest
// axis), up to 4 times its band's upper end. Where it depends on the frequency's components along and across
// `axis` alone, as that of oriented noise does, it is tabulated in these two, to some 1e-4 of its highest
// value, up to 2 times the upper end; otherwise it is evaluated where it is asked for.
template <int Dim>
SpectralDensity<Dim> spectral_density(const Noise<Dim>& noise, double block_length,
                                      const std::optional<Vec<Dim>>& axis = std::nullopt);

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
