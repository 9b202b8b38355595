#include "solidnoise/noise/gradient/gradient_noise.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "papers/data_file.h"
#include "papers/gradient_sample.h"
#include "papers/items.h"
#include "papers/stopwatch.h"
#include "reference/perlin_reference.h"
#include "reference/projected_kensler_pseudocode.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"

namespace solidnoise::papers {
namespace {

namespace fs = std::filesystem;

const std::array<std::pair<const char*, GradientKind>, 9> kKinds{
    {{"a", GradientKind::chained},
     {"b", GradientKind::xor_tables},
     {"c", GradientKind::wide},
     {"d", GradientKind::slice},
     {"e", GradientKind::projected},
     {"f", GradientKind::half},
     {"c_zero_dc", GradientKind::wide_zero_dc},
     {"d_zero_dc", GradientKind::slice_zero_dc},
     {"e_zero_dc", GradientKind::projected_zero_dc}}};

// The amplitude spectrum about frequency 0, mean square of squares of `factor` frequencies a side, as far as
// 1.28 cycles per unit for the full lattice.
DenseField<2> spectrum_picture(const PowerSpectrum<2>& spectrum, int factor) {
  const glm::ivec2 count = spectrum.count / factor;
  DenseField<2> picture(count, Vec<2>(1.0));
  const ArrayShape<2> shape{spectrum.count};
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const glm::ivec2 first = (ArrayShape<2>{count}.position(i) - count / 2) * factor;
    double sum = 0.0;
    for (int x = 0; x < factor; ++x) {
      for (int y = 0; y < factor; ++y) {
        const glm::ivec2 at = (first + glm::ivec2(x, y) + spectrum.count) % spectrum.count;
        sum += spectrum.density[shape.index(at)];
      }
    }
    picture.values[i] = static_cast<float>(std::sqrt(sum / (factor * factor)));
  }
  return picture;
}

// Figure 1.
void write_figure(const fs::path& folder) {
  Json json;
  for (const auto& [name, kind] : kKinds) {
    const DenseField<2> field = sample_gradient(kind, {});
    const PowerSpectrum<2> spectrum = gradient_spectrum(kind, field);
    write_field(folder / fmt::format("gradient_{}", name), field);
    write_field(folder / fmt::format("gradient_{}_spectrum", name), spectrum_picture(spectrum, 4));
    const BandLimit band = band_limit(spectrum);
    json[name] = {{"variance", spectrum.variance()},
                  {"peak", band.peak},
                  {"low_share", band.low_share},
                  {"striation_x", striation(spectrum, 0)},
                  {"striation_y", striation(spectrum, 1)}};
    Table radial{{"f", "density"}, {}};
    for (const RadialBin& bin : radial_average(spectrum, 0.02)) {
      radial.rows.push_back({bin.frequency, bin.power / spectrum.variance()});
    }
    write_table(folder / fmt::format("gradient_{}_radial.csv", name), radial);
  }
  write_json(folder / "gradient.json", json);
  // The closed forms of c and e, whose planes have the same; the noises have unit variance.
  Table closed{{"f", "kensler", "zero_dc"}, {}};
  const GradientKernel<2> kensler(GradientNoiseOptions::Kernel::kensler);
  const GradientKernel<2> zero_dc(GradientNoiseOptions::Kernel::zero_dc);
  for (double f = 0.0; f <= 2.0; f += 0.01) {
    closed.rows.push_back({f, kensler.power_spectrum(f) / kensler.mean_variance(),
                           zero_dc.power_spectrum(f) / zero_dc.mean_variance()});
  }
  write_table(folder / "gradient_closed.csv", closed);
}

// Half resolution with the window as printed, and as wide as it must be.
void write_planes(const fs::path& folder) {
  Table table{{"height", "full", "half_printed", "half_wide"}, {}};
  for (const double height : {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0}) {
    table.rows.push_back({height, plane_variance(1, height, 1.0, 400, 1),
                          plane_variance(2, height, 1.0, 400, 1), plane_variance(2, height, 2.0, 400, 1)});
  }
  write_table(folder / "gradient_planes.csv", table);
}

// Nanoseconds per sample of a procedure, at scattered points of three dimensions.
template <typename Procedure>
double nanoseconds_per_sample(const Procedure& procedure) {
  constexpr int kPoints = 100000;
  volatile float sink = 0.0f;
  const double seconds = quickest(20, [&] {
    float sum = 0.0f;
    for (int i = 0; i < kPoints; ++i) {
      const auto t = static_cast<float>(i);
      sum += procedure(std::array<float, 3>{0.131f * t, 0.073f * t, 0.047f * t});
    }
    sink = sum;
  });
  return 1e9 * seconds / kPoints;
}

// Section 5: costs as multiples of Perlin's noise, of the scalar procedures in single precision.
void write_costs(const fs::path& folder) {
  using Perlin = reference::PerlinProcedure<3, float>;
  using Pseudocode = reference::ProjectedKenslerPseudocode;
  const std::array<float, 3> normal{0.57735027f, 0.57735027f, 0.57735027f};
  const Perlin chained(Perlin::Hash::chained, 1);
  const Perlin xor_tables(Perlin::Hash::xor_tables, 1);
  const Pseudocode wide(Pseudocode::Projection::none, 1, 1);
  const Pseudocode projected(Pseudocode::Projection::onto_plane, 1, 1);
  const Pseudocode half(Pseudocode::Projection::onto_plane, 2, 1);
  write_json(
      folder / "gradient_costs.json",
      {{"chained", nanoseconds_per_sample(chained)},
       {"xor_tables", nanoseconds_per_sample(xor_tables)},
       {"wide", nanoseconds_per_sample([&](const std::array<float, 3>& x) { return wide(x, normal); })},
       {"projected",
        nanoseconds_per_sample([&](const std::array<float, 3>& x) { return projected(x, normal); })},
       {"half",
        nanoseconds_per_sample([&](const std::array<float, 3>& x) { return half(x, normal, 2.0f); })}});
}

}  // namespace

Items gradient_noise_items() {
  return {{"gradient", write_figure}, {"gradient_planes", write_planes}, {"gradient_costs", write_costs}};
}

}  // namespace solidnoise::papers
