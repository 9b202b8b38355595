#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "papers/data_file.h"
#include "papers/items.h"
#include "papers/kernel_speed.h"
#include "papers/noise_sample.h"
#include "papers/paper_kernel.h"
#include "papers/perlin_sample.h"
#include "papers/radii.h"
#include "papers/square.h"
#include "papers/tilted_plane.h"
#include "papers/transition.h"
#include "papers/truncation.h"
#include "solidnoise/analysis/field_picture.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise::papers {
namespace {

namespace fs = std::filesystem;

template <int Dim>
IsotropicGaborKernel<Dim> example_kernel() {
  return IsotropicGaborKernel<Dim>::with_unit_peak(kFrequency, kGaussian);
}

// Samples of value(distance from the middle) on a square with sides of twice the reach.
template <typename Function>
DenseField<2> radial_picture(double reach, const Function& value) {
  return sample_square(161, reach, [&](double x, double y) { return value(std::hypot(x, y)); });
}

// Figure 2.
void write_pictures(const fs::path& folder) {
  const auto kernel = example_kernel<2>();
  constexpr double kReach = 40.0;  // pixels
  write_field(folder / "kernel2d_gaussian", radial_picture(kReach, [](double r) {
                return std::exp(-std::numbers::pi * kGaussian * kGaussian * r * r);
              }));
  write_field(folder / "kernel2d_harmonic", radial_picture(kReach, [](double r) {
                return mean_cosine(2, 2.0 * std::numbers::pi * kFrequency * r);
              }));
  write_field(folder / "kernel2d_kernel", radial_picture(kReach, [&](double r) { return kernel.value(r); }));
  write_field(folder / "kernel2d_transform",
              radial_picture(0.15, [&](double f) { return kernel.spectrum(f); }));
}

// Figures 1, 2 and 6: kernels of unit peak, their transforms over their own maxima, and envelopes.
void write_kernels(const fs::path& folder) {
  write_pictures(folder);
  const auto k1 = example_kernel<1>();
  const auto k2 = example_kernel<2>();
  const auto k3 = example_kernel<3>();
  const auto k4 = example_kernel<4>();
  Table space{{"r", "gaussian", "n1", "n2", "n3", "n4", "e1", "e2", "e3", "e4"}, {}};
  for (double r = 0.25; r <= 40.0; r += 0.25) {
    space.rows.push_back({r, std::exp(-std::numbers::pi * kGaussian * kGaussian * r * r), k1.value(r),
                          k2.value(r), k3.value(r), k4.value(r), k1.envelope(r), k2.envelope(r),
                          k3.envelope(r), k4.envelope(r)});
  }
  write_table(folder / "kernels.csv", space);
  Table transform{{"f", "n1", "n2", "n3", "n4"}, {}};
  for (double f = 0.0; f <= 0.2; f += 0.0005) {
    transform.rows.push_back({f, k1.spectrum(f), k2.spectrum(f), k3.spectrum(f), k4.spectrum(f)});
  }
  write_table(folder / "transforms.csv", transform);
}

// Sections III-C and IV-B.
void write_radii(const fs::path& folder) {
  const Radii radii = example_radii();
  write_json(folder / "radii.json", {{"anisotropic_envelope", radii.anisotropic_envelope},
                                     {"isotropic_envelope", radii.isotropic_envelope},
                                     {"isotropic_envelope_exact", radii.isotropic_envelope_exact},
                                     {"isotropic_envelope_printed", radii.isotropic_envelope_printed},
                                     {"printed_share_of_maximum", radii.printed_share_of_maximum},
                                     {"anisotropic_error", radii.anisotropic_error},
                                     {"random_phase_error", radii.random_phase_error},
                                     {"isotropic_error", radii.isotropic_error},
                                     {"isotropic_error_printed", radii.isotropic_error_printed}});
}

// Figures 11 and 12.
void write_errors(const fs::path& folder) {
  const RandomPhaseGaborKernel<2> oriented(1.0, kGaussian, {kFrequency, 0.0});
  const auto k1 = example_kernel<1>();
  const auto k2 = example_kernel<2>();
  const auto k3 = example_kernel<3>();
  const auto k4 = example_kernel<4>();
  Table table{{"r", "n1", "n2", "n3", "n4", "anisotropic"}, {}};
  for (double r = 0.5; r <= 40.0; r += 0.25) {
    table.rows.push_back({r, k1.relative_error(r), k2.relative_error(r), k3.relative_error(r),
                          k4.relative_error(r), oriented.relative_error(r)});
  }
  write_table(folder / "errors.csv", table);
}

Table table_of(const SpectrumComparison& comparison) {
  Table table{{"f", "measured", "error", "expected"}, {}};
  for (const ComparedBin& bin : comparison.bins) {
    table.rows.push_back(
        {bin.measured.frequency, bin.measured.power, bin.measured.standard_error, bin.expected});
  }
  return table;
}

Json describe(const NoiseSample& sample) {
  return {{"impulses", sample.impulses},
          {"samples", sample.moments.count()},
          {"variance", sample.moments.sigma() * sample.moments.sigma()},
          {"variance_error", sample.variance_error},
          {"excess_kurtosis", sample.moments.excess_kurtosis()},
          {"expected_excess_kurtosis", sample.excess_kurtosis},
          {"chi_square", sample.radial.chi_square},
          {"degrees_of_freedom", sample.radial.degrees_of_freedom},
          {"significance", sample.radial.significance}};
}

// Figures 3, 4 and 5, and the same in 4 dimensions.
template <int Dim>
void write_noise(const fs::path& folder) {
  GaborNoiseOptions options;
  options.frequency = kFrequency;
  const NoiseSample sample = sample_noise<Dim>(options, {Dim == 1 ? 1024 : 256, Dim == 1 ? 512 : 64});
  const std::string stem = (folder / fmt::format("noise{}d", Dim)).string();
  write_field(stem + "_picture", sample.picture);
  Table histogram{{"value", "density", "gaussian"}, {}};
  for (std::size_t i = 0; i < sample.value.size(); ++i) {
    histogram.rows.push_back({sample.value[i], sample.density[i], sample.gaussian[i]});
  }
  write_table(stem + "_histogram.csv", histogram);
  write_table(stem + "_radial.csv", table_of(sample.radial));
  if constexpr (Dim > 1) {
    write_field(stem + "_transform", spectrum_magnitude(sample.picture, SpectrumWindow::hann));
    write_field(stem + "_estimated", centred(sample.estimated));
    write_field(stem + "_expected", centred(sample.expected));
  }
  // The paper's own quality: a Poisson process of 32 impulses, weights uniform on [-1, 1].
  options.impulses = 32.0;
  options.impulses_process = ImpulseSpread::poisson;
  options.weights = ImpulseWeights::uniform;
  const NoiseSample of_paper = sample_noise<Dim>(options, {Dim == 1 ? 1024 : 256, Dim == 1 ? 512 : 32});
  Json json{{"ours", describe(sample)}, {"paper", describe(of_paper)}};
  if constexpr (Dim > 2) {
    // Twice the frequency, so that the block holds more waves.
    options = {.frequency = 2.0 * kFrequency};
    const SpectrumComparison block = sample_block_spectrum<Dim>(options, {96, 12});
    write_table(stem + "_block.csv", table_of(block));
    json["block"] = {{"chi_square", block.chi_square},
                     {"degrees_of_freedom", block.degrees_of_freedom},
                     {"significance", block.significance}};
  }
  write_json(stem + ".json", json);
}

void write_truncated(const fs::path& folder, const std::string& name, const TruncatedNoise& noise) {
  write_field(folder / (name + "_whole"), noise.whole);
  write_field(folder / (name + "_truncated"), noise.truncated);
  write_field(folder / (name + "_difference"), noise.difference);
  write_json(folder / (name + ".json"), {{"radius", noise.radius},
                                         {"error_rms", noise.error_rms},
                                         {"standard_error", noise.standard_error},
                                         {"expected_rms", noise.expected_rms}});
}

// Figures 9 and 10.
void write_truncation(const fs::path& folder) {
  for (const int percent : {25, 1}) {
    TruncationOptions options;
    options.error = percent / 100.0;
    options.side = 256;
    write_truncated(folder, fmt::format("truncation2d_{}", percent), truncate_noise<2>(options));
    options.side = 16384;
    options.density = 0.4;
    write_truncated(folder, fmt::format("truncation1d_{}", percent), truncate_noise<1>(options));
  }
}

// Figure 14.
void write_transition(const fs::path& folder) {
  Table weights{{"alpha", "paper_fine", "paper_coarse", "power_fine", "power_coarse"}, {}};
  Table curves{{"alpha", "paper", "power"}, {}};
  Table measured{{"alpha", "paper", "paper_error", "power", "power_error", "fade", "fade_error"}, {}};
  for (int i = 0; i <= 100; ++i) {
    const double alpha = 0.01 * i;
    const ScaleWeights paper = scale_weights(ScaleTransition::paper, 2, alpha);
    const ScaleWeights power = scale_weights(ScaleTransition::power, 2, alpha);
    weights.rows.push_back({alpha, paper.fine, paper.coarse, power.fine, power.coarse});
    curves.rows.push_back({alpha, scale_variance(paper, 2, alpha), scale_variance(power, 2, alpha)});
  }
  for (const double alpha : {0.001, 0.1, 0.2, 1.0 / 3.0, 0.5, 0.65, 0.8, 0.999}) {
    std::vector<double> row{alpha};
    for (const ScaleTransition kind :
         {ScaleTransition::paper, ScaleTransition::power, ScaleTransition::fade}) {
      const TransitionVariance variance = transition_variance<2>(kind, alpha, 400000, 7);
      row.push_back(variance.measured);
      row.push_back(variance.standard_error);
    }
    measured.rows.push_back(row);
  }
  write_table(folder / "transition_weights.csv", weights);
  write_table(folder / "transition_variance.csv", curves);
  write_table(folder / "transition_measured.csv", measured);
}

// Figure 13.
void write_impulses(const fs::path& folder) {
  Table table{{"kind", "alpha", "level", "x", "y", "weight"}, {}};
  for (const double kind : {0.0, 1.0}) {
    for (const double alpha : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      for (const WeightedImpulse& impulse :
           weighted_impulses(kind == 0.0 ? ScaleTransition::paper : ScaleTransition::fade, alpha, 6, 8.0)) {
        table.rows.push_back(
            {kind, alpha, static_cast<double>(impulse.level), impulse.x, impulse.y, impulse.weight});
      }
    }
  }
  write_table(folder / "impulses.csv", table);
}

// Figure 15.
void write_strip(const fs::path& folder) {
  for (const auto& [name, kind] :
       {std::pair{"fade", ScaleTransition::fade}, {"paper", ScaleTransition::paper}}) {
    const VaryingStrip strip = varying_strip(kind, 1024, 192, 5);
    write_field(folder / fmt::format("strip_{}", name), strip.noise);
    Table table{{"alpha", "level", "rms"}, {}};
    const VaryingStrip tall = varying_strip(kind, 1024, 4096, 6);
    for (std::size_t i = 0; i < strip.alpha.size(); ++i) {
      table.rows.push_back({strip.alpha[i], strip.level[i], tall.column_rms[i]});
    }
    write_table(folder / fmt::format("strip_{}.csv", name), table);
  }
}

// Figure 8.
void write_plane(const fs::path& folder) {
  const TiltedPlane plane = tilted_plane({});
  write_field(folder / "plane_sampled", plane.sampled);
  write_field(folder / "plane_filtered", plane.filtered);
  write_field(folder / "plane_averaged", plane.averaged);
  Table table{{"cycles_per_pixel", "sampled", "filtered", "expected", "difference"}, {}};
  for (std::size_t row = 0; row < plane.cycles_per_pixel.size(); ++row) {
    table.rows.push_back({plane.cycles_per_pixel[row], plane.sampled_rms[row], plane.filtered_rms[row],
                          plane.expected_rms[row], plane.difference_rms[row]});
  }
  write_table(folder / "plane.csv", table);
}

template <int Dim>
void add_speeds(Table& table) {
  for (const Comparison comparison :
       {Comparison::same_density, Comparison::same_number, Comparison::same_quality}) {
    const KernelSpeed speed = measure_kernel_speed<Dim>(comparison);
    table.rows.push_back({static_cast<double>(Dim), static_cast<double>(comparison),
                          speed.anisotropic_impulses, speed.isotropic_impulses, speed.anisotropic_procedure,
                          speed.isotropic_procedure, speed.anisotropic_block, speed.isotropic_block});
  }
}

// Sections III-C and IV-B: times.
void write_kernel_speed(const fs::path& folder) {
  Table table{{"n", "comparison", "anisotropic_impulses", "isotropic_impulses", "anisotropic_procedure",
               "isotropic_procedure", "anisotropic_block", "isotropic_block"},
              {}};
  add_speeds<2>(table);
  add_speeds<3>(table);
  add_speeds<4>(table);
  write_table(folder / "kernel_speed.csv", table);
}

// Figure 7.
void write_perlin(const fs::path& folder) {
  const NoiseComparison comparison = compare_with_perlin(256, 64);
  write_field(folder / "perlin_noise", comparison.perlin);
  write_field(folder / "perlin_gabor", comparison.gabor);
  write_field(folder / "perlin_noise_spectrum", centred(comparison.perlin_spectrum));
  write_field(folder / "perlin_gabor_spectrum", centred(comparison.gabor_spectrum));
  Json json;
  for (const auto& [name, spectrum] :
       {std::pair{"perlin", &comparison.perlin_spectrum}, {"gabor", &comparison.gabor_spectrum}}) {
    json[name] = {{"below_peak", diagonal_over_axis(*spectrum, 0.5 * kFrequency, 1.3 * kFrequency)},
                  {"above_peak", diagonal_over_axis(*spectrum, 1.3 * kFrequency, 2.0 * kFrequency)}};
  }
  write_json(folder / "perlin.json", json);
}

}  // namespace

Items improving_gabor_noise_items() {
  return {{"kernels", write_kernels},  {"radii", write_radii},           {"errors", write_errors},
          {"noise1d", write_noise<1>}, {"noise2d", write_noise<2>},      {"noise3d", write_noise<3>},
          {"noise4d", write_noise<4>}, {"truncation", write_truncation}, {"transition", write_transition},
          {"strip", write_strip},      {"plane", write_plane},           {"kernel_speed", write_kernel_speed},
          {"perlin", write_perlin},    {"impulses", write_impulses}};
}

}  // namespace solidnoise::papers
