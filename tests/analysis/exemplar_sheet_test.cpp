#include "solidnoise/analysis/exemplar/exemplar_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"

namespace solidnoise::exemplar_sheet_test {
namespace {

// Two channels' worth of colours: brightness, and red against blue.
ExemplarModel two_tone(int dimensions) {
  GaborSpectrum waves;
  waves.dimensions = dimensions;
  waves.isotropic = dimensions == 3;
  waves.bands = {{0.2, {{{0.2, 0.0, 0.0}, 0.03}, {{0.1, 0.1, 0.0}, 0.01}}}};
  GaborSpectrum faint = waves;
  for (SpectrumComponent& component : faint.bands[0].components) component.variance *= 0.25;
  ExemplarModel model;
  model.channels = {waves, faint, faint};
  const double r2 = std::sqrt(0.5);
  model.axes = {{std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0)},
                {r2, 0.0, -r2},
                {std::sqrt(1.0 / 6.0), -std::sqrt(2.0 / 3.0), std::sqrt(1.0 / 6.0)}};
  model.mean = {0.5, 0.4, 0.3};
  model.raw_values = true;
  return model;
}

// Waves of a = 0.2 are independent over some 1 / (0.2^2) = 25 pixels, so that 256 x 256 pixels have some 2600
// independent values: variances scatter by sqrt(2 / 2600) = 3 %, means by a deviation of 0.2 / 50. Five of
// each.
TEST(ProceduralTexture, HasTheModelsMeanAndVariances) {
  for (const int dimensions : {2, 3}) {
    const ExemplarModel model = two_tone(dimensions);
    const Exemplar<2> texture = procedural_texture(model, glm::ivec2(256), Vec<2>(1.0), Vec<3>(0.0), 3);
    const CrossSpectra<2> spectra = cross_spectra<2>(std::vector{texture});
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(spectra.mean[static_cast<std::size_t>(c)], model.mean[c], 0.02);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec<3>& axis = model.axes[k];
      const double expected = model.channels[k].variance();
      EXPECT_NEAR(spectra.variance(std::array{axis.x, axis.y, axis.z}), expected, 0.15 * expected)
          << dimensions << "D, channel " << k;
    }
  }
}

// A place has its colour whatever part of the plane is asked for.
TEST(ProceduralTexture, DoesNotDependOnTheWindow) {
  const ExemplarModel model = two_tone(2);
  const Exemplar<2> whole = procedural_texture(model, glm::ivec2(80, 50), Vec<2>(1.0), Vec<3>(0.0), 3);
  const Exemplar<2> part =
      procedural_texture(model, glm::ivec2(20, 10), Vec<2>(1.0), Vec<3>(40.0, 30.0, 0.0), 3);
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 10; ++y) {
      EXPECT_NEAR(part.channels[0].values[static_cast<std::size_t>(10 * x + y)],
                  whole.channels[0].values[static_cast<std::size_t>(50 * (x + 40) + y + 30)], 1e-5);
    }
  }
}

TEST(ExemplarSheet, ShowsFourPanels) {
  for (const int dimensions : {2, 3}) {
    const ExemplarModel model = two_tone(dimensions);
    const Exemplar<2> texture = procedural_texture(model, glm::ivec2(64, 48), Vec<2>(1.0), Vec<3>(0.0), 3);
    const Image sheet = draw_exemplar_sheet(texture, model, {.title = "waves", .caption = "two tones"});
    // 64 pixels four times as large: over 200.
    EXPECT_EQ(sheet.width, 12 + 4 * (4 * 64 + 12));
    EXPECT_EQ(sheet.channels, 3);
    // The first panel is the exemplar: its top left pixel.
    EXPECT_NEAR(sheet.at(13, 12 + 26 + 1, 1), std::min(1.0f, std::max(0.0f, texture.channels[1].values[47])),
                1e-6);
  }
}

}  // namespace
}  // namespace solidnoise::exemplar_sheet_test
