#include "papers/gradient_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/perlin_reference.h"
#include "reference/projected_kensler_pseudocode.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"

namespace solidnoise::papers {
namespace {

// Two directions of the plane across (1, 1, 1).
const Vec<3> kRight{1.0 / std::sqrt(2.0), -1.0 / std::sqrt(2.0), 0.0};
const Vec<3> kUp{1.0 / std::sqrt(6.0), 1.0 / std::sqrt(6.0), -2.0 / std::sqrt(6.0)};
const double kNormal = 1.0 / std::sqrt(3.0);  // each component

bool is_zero_dc(GradientKind kind) {
  return kind == GradientKind::wide_zero_dc || kind == GradientKind::slice_zero_dc ||
         kind == GradientKind::projected_zero_dc;
}

bool repeats(GradientKind kind) {
  return kind == GradientKind::chained || kind == GradientKind::xor_tables || kind == GradientKind::wide ||
         kind == GradientKind::wide_zero_dc;
}

GradientNoiseOptions::Kernel kernel_of(GradientKind kind) {
  return is_zero_dc(kind) ? GradientNoiseOptions::Kernel::zero_dc : GradientNoiseOptions::Kernel::kensler;
}

void fill_perlin(reference::PerlinProcedure<2>::Hash hash, std::uint64_t seed, DenseField<2>& field) {
  const reference::PerlinProcedure<2> noise(hash, seed);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const glm::ivec2 at = ArrayShape<2>{field.count}.position(i);
    field.values[i] = static_cast<float>(noise({at.x * field.step.x, at.y * field.step.y}));
  }
}

// A noise of lattice spacing 1.
template <int Dim>
GradientNoise<Dim> lattice_noise(GradientKind kind, std::uint64_t seed) {
  GradientNoiseOptions options;
  options.kernel = kernel_of(kind);
  options.seed = seed;
  options.frequency = GradientKernel<Dim>(options.kernel).radial_peak();
  return GradientNoise<Dim>(options);
}

// Positions of the plane, in one batch per column.
struct Column {
  std::vector<Vec<3>> positions;

  Column(const DenseField<2>& field, int column) {
    for (int row = 0; row < field.count.y; ++row) {
      positions.push_back(field.step.x * column * kRight + field.step.y * row * kUp);
    }
  }
  Points<3> points() const { return {positions}; }
};

void fill_slice(GradientKind kind, std::uint64_t seed, DenseField<2>& field) {
  const GradientNoise<3> noise = lattice_noise<3>(kind, seed);
  const auto rows = static_cast<std::size_t>(field.count.y);
  for (int i = 0; i < field.count.x; ++i) {
    const Column column(field, i);
    noise.evaluate(column.points(),
                   {.values = std::span(field.values).subspan(static_cast<std::size_t>(i) * rows, rows)});
  }
}

void fill_projected(GradientKind kind, std::uint64_t seed, DenseField<2>& field) {
  ProjectedGradientOptions options;
  options.kernel = kernel_of(kind);
  options.seed = seed;
  if (kind == GradientKind::half) options.support = GradientNoiseOptions::Support::half;
  options.frequency = 1.0;
  options.frequency = ProjectedGradientNoise(options).lattice_spacing();  // then the spacing is 1
  const ProjectedGradientNoise noise(options);
  const auto rows = static_cast<std::size_t>(field.count.y);
  const std::vector<float> component(rows, static_cast<float>(kNormal));
  for (int i = 0; i < field.count.x; ++i) {
    const Column column(field, i);
    SurfacePoints surface;
    surface.positions = column.points();
    surface.normal = {component, component, component};
    noise.evaluate(surface,
                   {.values = std::span(field.values).subspan(static_cast<std::size_t>(i) * rows, rows)});
  }
}

}  // namespace

DenseField<2> sample_gradient(GradientKind kind, const GradientSampleSize& size) {
  DenseField<2> field({size.side, size.side}, Vec<2>(size.step));
  using Hash = reference::PerlinProcedure<2>::Hash;
  switch (kind) {
    case GradientKind::chained:
      fill_perlin(Hash::chained, size.seed, field);
      break;
    case GradientKind::xor_tables:
      fill_perlin(Hash::xor_tables, size.seed, field);
      break;
    case GradientKind::wide:
    case GradientKind::wide_zero_dc: {
      const Lattice<2> lattice{.step = field.step, .count = field.count};
      lattice_noise<2>(kind, size.seed).evaluate(lattice, {.values = field.values});
      break;
    }
    case GradientKind::slice:
    case GradientKind::slice_zero_dc:
      fill_slice(kind, size.seed, field);
      break;
    case GradientKind::projected:
    case GradientKind::half:
    case GradientKind::projected_zero_dc:
      fill_projected(kind, size.seed, field);
      break;
  }
  return field;
}

PowerSpectrum<2> gradient_spectrum(GradientKind kind, const DenseField<2>& field) {
  PeriodogramOptions options;
  options.window = repeats(kind) ? Window::none : Window::hann;
  return periodogram(field, options);
}

BandLimit band_limit(const PowerSpectrum<2>& spectrum) {
  constexpr double kBin = 0.05;  // cycles per unit
  BandLimit result;
  double highest = 0.0;
  for (const RadialBin& bin : radial_average(spectrum, kBin)) {
    if (bin.power <= highest) continue;
    highest = bin.power;
    result.peak = bin.frequency;
  }
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<2> f = spectrum.frequency(i);
    if (std::hypot(f.x, f.y) < 0.25 * result.peak) result.low_share += spectrum.density[i];
  }
  result.low_share *= spectrum.cell() / spectrum.variance();
  return result;
}

double striation(const PowerSpectrum<2>& spectrum, int axis) {
  const ArrayShape<2> shape{spectrum.count};
  const double step = spectrum.frequency_step(1 - axis);
  const int lines = std::min(static_cast<int>(0.5 / step), spectrum.count[1 - axis] / 2);
  std::vector<double> power(static_cast<std::size_t>(lines));
  for (int line = 0; line < lines; ++line) {
    for (int along = 0; along < spectrum.count[axis]; ++along) {
      const glm::ivec2 at = axis == 0 ? glm::ivec2(along, line + 1) : glm::ivec2(line + 1, along);
      power[static_cast<std::size_t>(line)] += spectrum.density[shape.index(at)];
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < power.size(); ++i) {
    const double ratio = (power[i + 1] - power[i]) / (power[i + 1] + power[i]);
    sum += ratio * ratio;
  }
  return std::sqrt(sum / static_cast<double>(power.size() - 1));
}

double plane_variance(int stride, double height, double window_reach, int side, std::uint64_t seed) {
  using Pseudocode = reference::ProjectedKenslerPseudocode;
  const Pseudocode noise(Pseudocode::Projection::onto_plane, stride, seed);
  double sum = 0.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      // A step that visits all places in a cell alike.
      const auto x = static_cast<float>(0.36 * stride * i);
      const auto y = static_cast<float>(0.36 * stride * j);
      const double value =
          noise({x, y, static_cast<float>(height)}, {0.0f, 0.0f, 1.0f}, static_cast<float>(window_reach));
      sum += value * value;
    }
  }
  return sum / (static_cast<double>(side) * side);
}

}  // namespace solidnoise::papers
