#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <span>
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

// The variance of brightness in rings of .05 cycles per pixel; in the lowest with that of trends, which the
// rings' window hides.
std::vector<double> rings_of(const std::vector<Exemplar<2>>& greys) {
  const ExemplarChannels channel = exemplar_channels<2>(cross_spectra<2>(greys), ColorAxes::rgb);
  std::vector<double> rings = frequency_rings(greys, channel).variances.front();
  const double seen = std::accumulate(rings.begin(), rings.end(), 0.0);
  rings.front() += std::max(channel.variances.front() - seen, 0.0);
  return rings;
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

// Of every photograph that ships, as noisefit takes it: what the noise draws is clipped as is told, and as
// sharp at all scales that hold a thousandth of the variance. The lowest ring has a few strong waves, by
// which single textures scatter.
TEST(Photographs, AreAsSharpAsWhatTheirNoiseDraws) {
  for (const auto& file : std::filesystem::directory_iterator(in_source("examples/exemplars"))) {
    if (file.path().extension() != ".jpg") continue;
    SCOPED_TRACE(file.path().filename());
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

    for (Exemplar<2>& exemplar : exemplars) make_grey(exemplar);
    for (Exemplar<2>& texture : textures) make_grey(texture);
    const std::vector<double> wanted = rings_of(exemplars);
    const std::vector<double> made = rings_of(textures);
    const double all = std::accumulate(wanted.begin(), wanted.end(), 0.0);
    for (std::size_t ring = 0; ring < wanted.size(); ++ring) {
      if (wanted[ring] < 1e-3 * all) continue;
      EXPECT_GT(made[ring], 0.8 * wanted[ring]) << "ring " << ring;
      EXPECT_LT(made[ring], 1.25 * wanted[ring]) << "ring " << ring;
    }
  }
}

}  // namespace
}  // namespace solidnoise::photographs_test
