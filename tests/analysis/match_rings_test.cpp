#include "solidnoise/analysis/exemplar/match_rings.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise::match_rings_test {
namespace {

constexpr int kSide = 480;

// As photographs are: steep, with fine detail that is strong in places only, darker to one side.
Exemplar<2> photograph() {
  PowerSpectrum<2> steep;
  steep.count = glm::ivec2(kSide);
  steep.step = Vec<2>(1.0);
  steep.density.resize(static_cast<std::size_t>(kSide) * kSide);
  PowerSpectrum<2> fine = steep;
  for (std::size_t i = 1; i < steep.density.size(); ++i) {
    const Vec<2> f = steep.frequency(i);
    const double squared = f.x * f.x + 0.5 * f.y * f.y;
    steep.density[i] = std::pow(0.02 * 0.02 + squared, -1.4);
    fine.density[i] = std::exp(-squared / (2.0 * 0.2 * 0.2));
  }
  DenseField<2> values = gaussian_field(steep, 11);
  const DenseField<2> detail = gaussian_field(fine, 12);
  const float share = static_cast<float>(0.2 * std::sqrt(steep.variance() / fine.variance()));
  const float slope = static_cast<float>(std::sqrt(steep.variance()) / kSide);
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      const auto at = static_cast<std::size_t>(i) * kSide + static_cast<std::size_t>(k);
      const float place = std::sin(0.013f * static_cast<float>(i)) * std::cos(0.017f * static_cast<float>(k));
      values.values[at] += share * (1.0f + place) * detail.values[at] + slope * static_cast<float>(i);
    }
  }
  Exemplar<2> exemplar;
  exemplar.channels.push_back(std::move(values));
  return exemplar;
}

// The power in rings of .05 cycles per sample, as anyone would measure it.
std::vector<double> measured_rings(const DenseField<2>& field) {
  const double mean =
      std::accumulate(field.values.begin(), field.values.end(), 0.0) / static_cast<double>(field.size());
  const PowerSpectrum<2> spectrum = periodogram(field, {.window = Window::hann, .mean = mean});
  std::vector<double> rings(15);
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<2> f = spectrum.frequency(i);
    rings[static_cast<std::size_t>(std::hypot(f.x, f.y) / 0.05)] += spectrum.density[i] * spectrum.cell();
  }
  return rings;
}

// Rings of a Gaussian field scatter by 2 / sqrt(frequencies): 1.5 % and less beyond the lowest, by chance 4
// times as much once in 16 000 rings.
TEST(MatchRings, NoiseIsAsSharpAsThePhotograph) {
  const Exemplar<2> exemplar = photograph();
  const std::vector<double> expected = measured_rings(exemplar.channels[0]);
  const double variance = std::accumulate(expected.begin(), expected.end(), 0.0);
  const auto ratios = [&](const ExemplarFitOptions& options) {
    const ExemplarFit<2> fit = fit_exemplar(std::span(&exemplar, 1), options);
    const Exemplar<2> noise = gaussian_texture(fit.model, glm::ivec2(kSide), Vec<2>(1.0), 5);
    std::vector<double> found = measured_rings(noise.channels[0]);
    for (std::size_t ring = 0; ring < found.size(); ++ring) found[ring] /= expected[ring];
    return found;
  };
  const std::vector<double> found = ratios({});
  for (std::size_t ring = 1; ring < found.size(); ++ring) {
    if (expected[ring] < 1e-3 * variance) continue;
    EXPECT_NEAR(found[ring], 1.0, 0.12) << "ring " << ring;
  }
}

// A picture that repeats, of a few waves around a slanting one and faint grain: by chance a window sees less
// of them than there is, or more, and low frequencies, of which there are none, have nothing to do with that.
TEST(MatchRings, NarrowBandsGetNoLowFrequencies) {
  PowerSpectrum<2> band;
  band.count = glm::ivec2(256);
  band.step = Vec<2>(1.0);
  band.density.resize(std::size_t{256} * 256);
  for (std::size_t i = 0; i < band.density.size(); ++i) {
    const Vec<2> from = glm::abs(band.frequency(i)) - Vec<2>(0.11, 0.06);
    const bool slants = band.frequency(i).x * band.frequency(i).y > 0.0;
    band.density[i] = (slants ? std::exp(-glm::dot(from, from) / (2.0 * 0.006 * 0.006)) : 0.0) + 1e-7;
  }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Exemplar<2> exemplar;
    exemplar.channels.push_back(gaussian_field(band, seed));
    const ExemplarFit<2> fit = fit_exemplar<2>(std::vector{exemplar}, {});
    double low = 0.0;
    for (const SpectrumBand& of : fit.channels[0].spectrum.bands) {
      for (const SpectrumComponent& component : of.components)
        low += glm::length(component.frequency) < 0.05 ? component.variance : 0.0;
    }
    EXPECT_LT(low, 0.02 * fit.channels[0].spectrum.variance()) << seed;
  }
}

// Two broad components over three rings: the least that a ring of them can be wrong by is none.
TEST(MatchRings, GivesEachRingItsPower) {
  FrequencyRings rings;
  rings.width = 0.1;
  rings.variances = {{1.25, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0}};
  GaborSpectrum spectrum;
  spectrum.bands = {{0.02, {{{0.05, 0.0, 0.0}, 1.0}, {{0.0, 0.15, 0.0}, 1.0}, {{0.18, 0.18, 0.0}, 1.0}}}};
  match_rings(spectrum, rings, 0);
  EXPECT_NEAR(spectrum.variance(), 2.0, 1e-12);
  EXPECT_NEAR(spectrum.bands[0].components[0].variance, 1.25, 1e-3);
  EXPECT_NEAR(spectrum.bands[0].components[1].variance, 0.5, 1e-3);
  EXPECT_NEAR(spectrum.bands[0].components[2].variance, 0.25, 1e-3);
}

}  // namespace
}  // namespace solidnoise::match_rings_test
