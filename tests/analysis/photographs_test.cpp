#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/frequency_rings.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "support/paths.h"

namespace solidnoise::photographs_test {
namespace {

// The variance of a linear function of colour in rings of .05 cycles per pixel; in the lowest with that of
// trends.
std::vector<double> rings_of(const std::vector<Exemplar<2>>& pictures, const std::array<float, 3>& function) {
  std::vector<Exemplar<2>> greys;
  for (const Exemplar<2>& picture : pictures) {
    DenseField<2> grey(picture.shape().count, picture.shape().step);
    for (std::size_t i = 0; i < grey.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) grey.values[i] += function[k] * picture.channels[k].values[i];
    }
    greys.push_back({{std::move(grey)}});
  }
  return frequency_rings(greys, exemplar_channels<2>(cross_spectra<2>(greys), ColorAxes::rgb))
      .variances.front();
}

// The mean share of what no screen shows.
double clipped_share(const std::vector<Exemplar<2>>& pictures) {
  double clipped = 0.0;
  double all = 0.0;
  for (const Exemplar<2>& picture : pictures) {
    for (const DenseField<2>& channel : picture.channels) {
      clipped += static_cast<double>(std::count_if(channel.values.begin(), channel.values.end(),
                                                   [](float value) { return value < 0.0f || value > 1.0f; }));
      all += static_cast<double>(channel.size());
    }
  }
  return clipped / all;
}

// What an eye sees of colours, and how much a texture may have of it, over what the photograph has, in rings
// that hold this share of it.
struct Seen {
  const char* name;
  std::array<float, 3> function;
  double share, least, most;
};
constexpr Seen kSeen[] = {
    {"brightness", {0.2126f, 0.7152f, 0.0722f}, 1e-3, 0.8, 1.25},
    {"red", {1.0f, 0.0f, 0.0f}, 1e-3, 0.8, 1.25},
    {"green", {0.0f, 1.0f, 0.0f}, 1e-3, 0.8, 1.25},
    {"blue", {0.0f, 0.0f, 1.0f}, 1e-3, 0.8, 1.25},
    {"red-green", {1.0f, -1.0f, 0.0f}, 0.03, 0.5, 2.0},
    {"blue-yellow", {-0.5f, -0.5f, 1.0f}, 0.03, 0.5, 2.0},
};

// Of every photograph that ships, as noisefit takes it: what the noise draws is clipped as is told, and as
// sharp at all scales. The lowest ring has a few strong waves, by which single textures scatter.
TEST(Photographs, AreAsSharpAsWhatTheirNoiseDraws) {
  for (const auto& file : std::filesystem::directory_iterator(in_source("examples/exemplars"))) {
    if (file.path().extension() != ".jpg") continue;
    std::vector exemplars{read_exemplar(file.path(), {.raw_values = true})};
    const ValueChoice choice = choose_values(exemplars, {false});
    ExemplarFitOptions options;
    options.raw_values = choice.raw_values;
    options.squares = choice.squares;
    const ExemplarModel model = fit_exemplar<2>(exemplars, options).model;
    const DenseField<2>& shape = exemplars.front().shape();
    std::vector<Exemplar<2>> textures;
    for (std::uint64_t seed = 1; seed <= 16; ++seed)
      textures.push_back(procedural_texture(model, shape.count, shape.step, Vec<3>(0.0), seed));
    EXPECT_LT(choice.fit.clipped, 0.005);
    EXPECT_NEAR(clipped_share(textures), choice.fit.clipped, 2e-4 + 0.15 * choice.fit.clipped);

    for (const Seen& seen : kSeen) {
      SCOPED_TRACE(file.path().filename().string() + ", " + seen.name);
      const std::vector<double> wanted = rings_of(exemplars, seen.function);
      const std::vector<double> made = rings_of(textures, seen.function);
      const double all = std::accumulate(wanted.begin(), wanted.end(), 0.0);
      for (std::size_t ring = 0; ring < wanted.size(); ++ring) {
        if (wanted[ring] < seen.share * all) continue;
        EXPECT_GT(made[ring], seen.least * wanted[ring]) << "ring " << ring;
        EXPECT_LT(made[ring], seen.most * wanted[ring]) << "ring " << ring;
      }
    }
  }
}

}  // namespace
}  // namespace solidnoise::photographs_test
