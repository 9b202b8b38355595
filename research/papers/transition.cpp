#include "papers/transition.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "papers/paper_kernel.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"

namespace solidnoise::papers {
namespace {

constexpr double kOctave = 1.0;  // bandwidth

template <int Dim>
VaryingGaborNoise<Dim> make_noise(ScaleTransition transition, std::uint64_t seed) {
  VaryingGaborOptions options;
  options.frequency = kFrequency;
  options.bandwidth = kOctave;
  options.transition = transition;
  options.seed = seed;
  return VaryingGaborNoise<Dim>(options);
}

// Points of a batch and a parameter at each.
template <int Dim>
struct Batch {
  std::vector<Vec<Dim>> positions;
  std::vector<float> frequency;

  std::vector<float> evaluate(const VaryingGaborNoise<Dim>& noise) const {
    VaryingParameters<Dim> parameters;
    parameters.frequency = frequency;
    std::vector<float> values(frequency.size());
    noise.evaluate(Points<Dim>{positions}, parameters, {.values = values});
    return values;
  }
};

}  // namespace

template <int Dim>
TransitionVariance transition_variance(ScaleTransition transition, double alpha, int points,
                                       std::uint64_t seed) {
  constexpr int kParts = 16;
  // The radius is inversely proportional to the frequency, and (1 + alpha) 2^4 here.
  const VaryingGaborNoise<Dim> probe = make_noise<Dim>(transition, seed);
  const double radius = 16.0 * (1.0 + alpha);
  const double frequency = kFrequency * probe.radius(kFrequency, kOctave) / radius;
  const int side = static_cast<int>(std::ceil(std::pow(static_cast<double>(points) / kParts, 1.0 / Dim)));

  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int part = 0; part < kParts; ++part) {
    const VaryingGaborNoise<Dim> noise = make_noise<Dim>(transition, seed + static_cast<std::uint64_t>(part));
    Batch<Dim> batch;
    std::size_t count = 1;
    for (int axis = 0; axis < Dim; ++axis) count *= static_cast<std::size_t>(side);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t rest = i;
      Vec<Dim>& position = batch.positions.emplace_back();
      for (int axis = 0; axis < Dim; ++axis) {
        position[axis] = 0.5 * radius * static_cast<double>(rest % static_cast<std::size_t>(side));
        rest /= static_cast<std::size_t>(side);
      }
    }
    batch.frequency.assign(count, static_cast<float>(frequency));
    double power = 0.0;
    for (const float value : batch.evaluate(noise)) power += static_cast<double>(value) * value;
    power /= static_cast<double>(count);
    sum += power;
    sum_of_squares += power * power;
  }
  TransitionVariance result;
  result.measured = sum / kParts;
  result.standard_error =
      std::sqrt((sum_of_squares / kParts - result.measured * result.measured) / (kParts - 1));
  result.expected = transition == ScaleTransition::fade
                        ? 1.0
                        : scale_variance(scale_weights(transition, Dim, alpha), Dim, alpha);
  return result;
}

std::vector<WeightedImpulse> weighted_impulses(ScaleTransition transition, double alpha, int side,
                                               double impulses) {
  const ScaleFade fade(2);
  const ScaleWeights weights = scale_weights(transition, 2, alpha);
  const bool fades = transition == ScaleTransition::fade;
  // Impulses that come and go have turns between a quarter and 1 of the density that their grid is for.
  const double density =
      impulses / std::numbers::pi * (fades ? fade.impulses_per_effective_one * (1.0 - fade.lowest) : 1.0);
  std::vector<WeightedImpulse> result;
  for (const int level : {0, 1}) {
    const double size = level + 1.0;
    const ImpulseProcess<2> process({CellAxis(size), CellAxis(size)}, {density, false},
                                    derive_seed(1, static_cast<std::uint64_t>(level)));
    const auto cells = static_cast<std::int64_t>(side / size);
    for (std::int64_t i = 0; i < cells * cells; ++i) {
      const Index<2> cell(i / cells, i % cells);
      process.generate(cell, [&](const Impulse<2>& impulse) {
        const double u = RandomStream(impulse.mark).next_unit();
        const double turn = std::pow((1.0 + alpha) / size, 2) * (fade.lowest + (1.0 - fade.lowest) * u);
        WeightedImpulse weighted;
        weighted.level = level;
        weighted.x = (static_cast<double>(cell.x) +
                      impulse.position[0] / static_cast<double>(CellAxis::kQuantaPerCell)) *
                     size;
        weighted.y = (static_cast<double>(cell.y) +
                      impulse.position[1] / static_cast<double>(CellAxis::kQuantaPerCell)) *
                     size;
        weighted.weight = fades ? fade(turn) : (level == 0 ? weights.fine : weights.coarse);
        result.push_back(weighted);
      });
    }
  }
  return result;
}

VaryingStrip varying_strip(ScaleTransition transition, int columns, int rows, std::uint64_t seed) {
  const VaryingGaborNoise<2> noise = make_noise<2>(transition, seed);
  VaryingStrip strip;
  strip.noise = DenseField<2>({columns, rows}, Vec<2>(1.0));
  Batch<2> batch;
  for (int column = 0; column < columns; ++column) {
    const double frequency = 0.5 * kFrequency * std::exp2(3.0 * column / (columns - 1.0));
    const double level = std::log2(noise.radius(frequency, kOctave));
    strip.level.push_back(std::floor(level));
    strip.alpha.push_back(std::exp2(level - std::floor(level)) - 1.0);
    for (int row = 0; row < rows; ++row) {
      batch.positions.emplace_back(column, row);
      batch.frequency.push_back(static_cast<float>(frequency));
    }
  }
  strip.noise.values = batch.evaluate(noise);
  for (int column = 0; column < columns; ++column) {
    double power = 0.0;
    for (int row = 0; row < rows; ++row) {
      const double value = strip.noise.values[ArrayShape<2>{strip.noise.count}.index({column, row})];
      power += value * value;
    }
    strip.column_rms.push_back(std::sqrt(power / rows));
  }
  return strip;
}

template TransitionVariance transition_variance<2>(ScaleTransition, double, int, std::uint64_t);
template TransitionVariance transition_variance<3>(ScaleTransition, double, int, std::uint64_t);

}  // namespace solidnoise::papers
