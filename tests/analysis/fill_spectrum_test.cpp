#include "solidnoise/analysis/exemplar/fill_spectrum.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise::fill_spectrum_test {
namespace {

// As steep as photographs are, and twice as strong along one axis.
PowerSpectrum<2> steep_spectrum(int side) {
  PowerSpectrum<2> truth;
  truth.count = glm::ivec2(side);
  truth.step = Vec<2>(1.0);
  truth.window = Window::none;
  truth.density.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (std::size_t i = 0; i < truth.density.size(); ++i) {
    const Vec<2> f = truth.frequency(i);
    truth.density[i] = i == 0 ? 0.0 : std::pow(0.02 * 0.02 + f.x * f.x + 0.5 * f.y * f.y, -1.4);
  }
  return truth;
}

struct Ring {
  double share = 0.0;  // of the variance, of the exemplar
  double ratio = 0.0;  // of the model over the exemplar
};

// Rings of .05 cycles per sample.
std::vector<Ring> compare_rings(const PowerSpectrum<2>& model, const PowerSpectrum<2>& exemplar) {
  constexpr double kWidth = 0.05;
  std::array<double, 16> of_model{};
  std::array<double, 16> of_exemplar{};
  for (std::size_t i = 0; i < model.density.size(); ++i) {
    const Vec<2> f = model.frequency(i);
    const auto ring = static_cast<std::size_t>(std::hypot(f.x, f.y) / kWidth);
    of_model[ring] += model.density[i] * model.cell();
    of_exemplar[ring] += exemplar.density[i] * exemplar.cell();
  }
  std::vector<Ring> rings;
  for (std::size_t ring = 0; ring < of_model.size(); ++ring) {
    if (of_exemplar[ring] > 0.0) {
      rings.push_back({of_exemplar[ring] / exemplar.variance(), of_model[ring] / of_exemplar[ring]});
    }
  }
  return rings;
}

// What an eye sees as sharpness: every ring that holds a thousandth of the variance.
TEST(FillSpectrum, KeepsThePowerOfEveryRing) {
  for (const int side : {128, 200}) {
    const PowerSpectrum<2> truth = steep_spectrum(side);
    Exemplar<2> exemplar;
    exemplar.channels.push_back(gaussian_field(truth, 3));
    const CrossSpectra<2> spectra = cross_spectra<2>(std::span(&exemplar, 1));
    const PowerSpectrum<2> periodogram = spectra.spectrum(std::array{1.0});
    const auto rings_of = [&](const SpectrumFitOptions& options) {
      const SpectrumFit fit = fit_spectrum(periodogram, spectra.variance(std::array{1.0}), options);
      EXPECT_NEAR(fit.spectrum.variance(), spectra.variance(std::array{1.0}), 1e-9);
      return compare_rings(sampled_density<2>(fit.spectrum, periodogram.count, periodogram.step),
                           periodogram);
    };
    for (const Ring& ring : rings_of({})) {
      if (ring.share < 1e-3) continue;
      EXPECT_GT(ring.ratio, 0.8) << "share " << ring.share;
      EXPECT_LT(ring.ratio, 1.25) << "share " << ring.share;
    }
    // The highest of them are nearly lost without it.
    const std::vector<Ring> sparse = rings_of({.fill = false});
    EXPECT_LT(sparse[8].ratio, 0.5);
  }
}

}  // namespace
}  // namespace solidnoise::fill_spectrum_test
