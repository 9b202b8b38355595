#include "papers/perlin_sample.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "papers/paper_kernel.h"
#include "reference/perlin_reference.h"
#include "solidnoise/noise/gabor/gabor_noise.h"

namespace solidnoise::papers {
namespace {

// The frequency of the largest density of Perlin's noise, in cycles per lattice unit.
constexpr double kPerlinPeak = 0.5;

DenseField<2> sample_perlin(int side, std::uint64_t seed) {
  using Perlin = reference::PerlinProcedure<2>;
  const Perlin noise(Perlin::Hash::xor_tables, seed);
  const double step = kFrequency / kPerlinPeak;
  DenseField<2> field({side, side}, Vec<2>(1.0));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const glm::ivec2 at = ArrayShape<2>{field.count}.position(i);
    field.values[i] = static_cast<float>(noise({step * at.x, step * at.y}));
  }
  return field;
}

DenseField<2> sample_gabor(int side, std::uint64_t seed) {
  GaborNoiseOptions options;
  options.frequency = kFrequency;
  options.seed = seed;
  DenseField<2> field({side, side}, Vec<2>(1.0));
  GaborNoise<2>(options).evaluate(Lattice<2>{.count = field.count}, {.values = field.values});
  return field;
}

}  // namespace

NoiseComparison compare_with_perlin(int side, int seeds) {
  NoiseComparison result;
  PeriodogramAverage<2> perlin(glm::ivec2(side), Vec<2>(1.0));
  PeriodogramAverage<2> gabor(glm::ivec2(side), Vec<2>(1.0));
  for (int seed = 0; seed < seeds; ++seed) {
    DenseField<2> of_perlin = sample_perlin(side, static_cast<std::uint64_t>(seed));
    DenseField<2> of_gabor = sample_gabor(side, static_cast<std::uint64_t>(seed));
    perlin.add(of_perlin.values);
    gabor.add(of_gabor.values);
    if (seed > 0) continue;
    result.perlin = std::move(of_perlin);
    result.gabor = std::move(of_gabor);
  }
  result.perlin_spectrum = perlin.spectrum();
  result.gabor_spectrum = gabor.spectrum();
  return result;
}

double diagonal_over_axis(const PowerSpectrum<2>& spectrum, double lower, double upper) {
  constexpr double kWedge = std::numbers::pi / 12.0;
  constexpr double kQuarter = std::numbers::pi / 2.0;
  double axis = 0.0;
  double diagonal = 0.0;
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<2> f = spectrum.frequency(i);
    const double length = std::hypot(f.x, f.y);
    if (length < lower || length >= upper) continue;
    const double angle = std::fmod(std::atan2(f.y, f.x) + 2.0 * std::numbers::pi, kQuarter);
    if (angle < kWedge || angle > kQuarter - kWedge) axis += spectrum.density[i];
    if (std::abs(angle - 0.5 * kQuarter) < kWedge) diagonal += spectrum.density[i];
  }
  return diagonal / axis;
}

}  // namespace solidnoise::papers
