#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "papers/data_file.h"
#include "papers/items.h"
#include "papers/literal_fit.h"
#include "papers/stopwatch.h"
#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/image/image_file.h"

namespace solidnoise::papers {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 128;  // as in the paper
constexpr std::array kNames{"sand", "soil", "earth", "rock", "moss", "leaves", "wood"};

Exemplar<2> read_photograph(const std::string& name) {
  return read_exemplar(fs::path(SOLIDNOISE_EXEMPLARS) / (name + ".jpg"), {.raw_values = true});
}

// The brightness of the middle of a photograph.
Exemplar<2> grey_middle(const Exemplar<2>& photograph) {
  constexpr std::array<float, 3> kWeights{0.2126f, 0.7152f, 0.0722f};
  const glm::ivec2 first = (photograph.shape().count - kSide) / 2;
  DenseField<2> grey({kSide, kSide}, photograph.shape().step);
  const ArrayShape<2> shape{grey.count};
  for (std::size_t i = 0; i < grey.values.size(); ++i) {
    const std::size_t from = ArrayShape<2>{photograph.shape().count}.index(first + shape.position(i));
    for (std::size_t c = 0; c < photograph.channels.size(); ++c) {
      const float weight = photograph.channels.size() == 3 ? kWeights[c] : 1.0f;
      grey.values[i] += weight * photograph.channels[c].values[from];
    }
  }
  Exemplar<2> result;
  result.channels = {grey};
  return result;
}

PowerSpectrum<2> periodogram_of(const Exemplar<2>& grey) {
  return cross_spectra<2>(std::span(&grey, 1)).spectrum(std::array{1.0});
}

ExemplarFit<2> fit(const Exemplar<2>& grey, const SpectrumFitOptions& options) {
  ExemplarFitOptions fit_options;
  fit_options.spectrum = options;
  fit_options.raw_values = true;
  return fit_exemplar<2>(std::span(&grey, 1), fit_options);
}

DenseField<2> picture_of(const GaborSpectrum& spectrum, const PowerSpectrum<2>& like) {
  return centred(sampled_density<2>(spectrum, like.count, like.step));
}

// Figure 2: the bands of one noise, each alone.
void write_bands(const fs::path& folder) {
  const Exemplar<2> grey = grey_middle(read_photograph("soil"));
  const PowerSpectrum<2> periodogram = periodogram_of(grey);
  const ExemplarModel model = fit(grey, SpectrumFitOptions::of_paper()).model;
  Table table{{"a", "components", "share"}, {}};
  const auto write = [&](const std::string& name, const GaborSpectrum& spectrum) {
    ExemplarModel one = model;
    one.channels = {spectrum};
    one.mean = Vec<3>(0.0);
    write_field(folder / ("bands_" + name + "_spectrum"), picture_of(spectrum, periodogram));
    write_field(folder / ("bands_" + name + "_noise"),
                procedural_texture(one, {kSide, kSide}, grey.shape().step, Vec<3>(0.0), 1).channels.front());
  };
  const GaborSpectrum& all = model.channels.front();
  write("all", all);
  for (std::size_t i = 0; i < all.bands.size(); ++i) {
    GaborSpectrum band = all;
    band.bands = {all.bands[i]};
    write(fmt::format("{}", i), band);
    table.rows.push_back({all.bands[i].a, static_cast<double>(all.bands[i].components.size()),
                          band.variance() / all.variance()});
  }
  write_table(folder / "bands.csv", table);
}

// Figure 3: ever more components.
void write_kappas(const fs::path& folder) {
  const Exemplar<2> grey = grey_middle(read_photograph("soil"));
  const PowerSpectrum<2> periodogram = periodogram_of(grey);
  write_field(folder / "kappa_exemplar", grey.channels.front());
  write_field(folder / "kappa_periodogram", centred(periodogram));
  Table table{{"inverse_kappa", "components", "residual"}, {}};
  for (int inverse = 2; inverse <= 256; inverse *= 2) {
    SpectrumFitOptions options = SpectrumFitOptions::of_paper();
    options.kappa = 1.0 / inverse;
    const ExemplarFit<2> found = fit(grey, options);
    const SpectrumFit& channel = found.channels.front();
    write_field(folder / fmt::format("kappa_{}", inverse), picture_of(channel.spectrum, periodogram));
    table.rows.push_back(
        {static_cast<double>(inverse), static_cast<double>(channel.components), channel.residual});
  }
  write_table(folder / "kappa.csv", table);
}

// Figure 4.
void write_sheets(const fs::path& folder) {
  for (const char* name : {"sand", "moss", "wood"}) {
    const Exemplar<2> grey = grey_middle(read_photograph(name));
    const ExemplarModel model = fit(grey, SpectrumFitOptions::of_paper()).model;
    write_image(folder / fmt::format("sheet_{}.png", name), draw_exemplar_sheet(grey, model),
                {.existing = Existing::replace});
  }
}

// Sections 5 to 8: sparseness, time, J.
void write_numbers(const fs::path& folder) {
  Json json;
  for (const char* name : kNames) {
    const Exemplar<2> photograph = read_photograph(name);
    const Exemplar<2> grey = grey_middle(photograph);
    SpectrumFit paper;
    SpectrumFit ours;
    const double paper_seconds =
        quickest(1, [&] { paper = fit(grey, SpectrumFitOptions::of_paper()).channels.front(); });
    const double our_seconds = quickest(1, [&] { ours = fit(grey, {}).channels.front(); });
    const ExemplarChannels channels =
        exemplar_channels(cross_spectra<2>(std::span(&photograph, 1)), ColorAxes::independent);
    json[name] = {{"paper_components", paper.components},
                  {"paper_sparseness", paper.sparseness},
                  {"paper_residual", paper.residual},
                  {"paper_seconds", paper_seconds},
                  {"components", ours.components},
                  {"sparseness", ours.sparseness},
                  {"seconds", our_seconds}};
    if (channels.dependence) {
      json[name]["j_rgb"] = channels.dependence->rgb;
      json[name]["j_pca"] = channels.dependence->pca;
      json[name]["j_independent"] = channels.dependence->independent;
    }
  }
  write_json(folder / "example_numbers.json", json);
}

// Eq. 8, read in two ways.
void write_literal(const fs::path& folder) {
  const PowerSpectrum<2> periodogram = periodogram_of(grey_middle(read_photograph("soil")));
  Json json;
  for (const auto& [name, penalty] :
       {std::pair{"squared_magnitudes", Penalty::squared_magnitudes}, {"lengths", Penalty::lengths}}) {
    const BandCounts found = fit_bands(periodogram, 1.0 / 256.0, penalty, 100);
    json[name] = {{"components", found.components}, {"residual", found.residual}};
  }
  write_json(folder / "literal.json", json);
}

}  // namespace

Items noise_by_example_items() {
  return {{"example_bands", write_bands},
          {"example_kappas", write_kappas},
          {"example_sheets", write_sheets},
          {"example_numbers", write_numbers},
          {"example_literal", write_literal}};
}

}  // namespace solidnoise::papers
