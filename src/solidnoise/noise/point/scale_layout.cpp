#include "solidnoise/noise/point/scale_layout.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/point/scale_fade.h"

namespace solidnoise {
namespace {

// What strata keep of the integral of fade^4 over the turns of a grid whose cells are `cell` scales large: in
// pieces of cells, and in whole ones.
struct FadedShares {
  FadedShares(const ScaleFade& fade, const ImpulseCount& count, double cell) {
    const int parts = static_cast<int>(count.mean);
    const int steps = std::clamp(512 / parts, 1, 32);         // of a part
    const double densest = std::pow(cell, -fade.dimensions);  // y where u is 1
    const double all = densest * (1.0 - fade.lowest);
    double mean = 0.0;
    double squares = 0.0;
    for (int k = 0; k < parts; ++k) {
      double of_part = 0.0;
      for (int step = 0; step < steps; ++step) {
        of_part += squared(fade(densest * fade.lowest + all * (k + (step + 0.5) / steps) / parts)) / steps;
      }
      mean += of_part / parts;
      squares += squared(of_part) / parts;
    }
    in_cells = all * squares;
    if (count.halvings == 0) return;
    const double variance = (squares - squared(mean)) / (parts - 1);
    in_pieces = all * (squared(mean) - variance);
    in_cells = all * parts * variance;
  }

  double in_pieces = 0.0;
  double in_cells = 0.0;
};

// Of both grids of a level whose cells are `cell` scales large, and the next's twice that, what strata keep
// of the integral of fade^4 times what cubes of a side, in scales, keep of the kernel's.
double kept(const ScaleFade& fade, const ImpulseCount& count, double cell,
            const std::function<double(double)>& of_side) {
  const FadedShares fine(fade, count, cell);
  const FadedShares coarse(fade, count, 2.0 * cell);
  const double pieces = std::ldexp(1.0, -count.halvings);
  return fine.in_pieces * of_side(pieces * cell) + coarse.in_pieces * of_side(pieces * 2.0 * cell) +
         fine.in_cells * of_side(cell) + coarse.in_cells * of_side(2.0 * cell);
}

// The cells of the levels of some scales, over these: evenly over the octave that has one level.
constexpr int kScales = 8;
double cell_of(int i) {
  return std::exp2(-(i + 0.5) / kScales);
}

// Of a layout's numbers in cells, for this density of effective impulses.
double scale_of_density(const ScaleLayout& layout, double effective) {
  const double of_scales = layout.density() / ScaleFade(layout.dimensions).impulses_per_effective_one;
  return std::pow(of_scales / effective, 1.0 / layout.dimensions);
}

// With the fewest impulses.
double default_scale(const StrataChoice& choice, ScaleLayout layout) {
  constexpr double kPlentyOverPoisson = 4.0;
  const double poisson = choice.poisson_density();
  const double plenty = scale_of_density(layout, kPlentyOverPoisson * poisson);
  const auto scale_of_kurtosis = [&](double kurtosis, double least, double most) {
    return balanced_side(
        [&](double scale) {
          layout.scale = scale;
          return layout.excess_kurtosis(choice, choice.moments) - kurtosis;
        },
        least, most);
  };
  const bool in_mean = choice.kurtosis <= kMeanKurtosis;
  const double balanced = scale_of_kurtosis(in_mean ? 0.0 : choice.kurtosis, plenty, 8.0 * choice.radius);
  if (balanced > plenty) return balanced;
  return scale_of_kurtosis(in_mean ? StrataChoice::kWantedMean : choice.kurtosis,
                           scale_of_density(layout, StrataChoice::kMostOverPoisson * poisson), plenty);
}

}  // namespace

double ScaleLayout::density() const {
  return count.mean / (1.0 - std::exp2(-dimensions));
}

double ScaleLayout::effective_density() const {
  return density() / std::pow(scale, dimensions) / ScaleFade(dimensions).impulses_per_effective_one;
}

double ScaleLayout::excess_kurtosis(const StrataChoice& choice, const KernelMoments& moments) const {
  const ScaleFade fade(dimensions);
  KernelMoments faded{moments.second * fade.second_moment, moments.fourth * fade.fourth_moment};
  for (int i = 0; count.is_fixed && i < kScales; ++i) {
    const auto of_side = [&](double side) { return choice.averages->overlap({side * scale}); };
    faded.overlap +=
        kept(fade, count, cell_of(i), of_side) / kScales * squared(moments.second / choice.moments.second);
  }
  return noise_excess_kurtosis(density() / std::pow(scale, dimensions), faded, choice.weights);
}

double ScaleLayout::kurtosis_given_place(const StrataChoice& choice) const {
  constexpr int kHarmonics = 2;
  if (!count.is_fixed) return 0.0;
  const ScaleFade fade(dimensions);
  double most = 0.0;
  for (int i = 0; i < kScales; ++i) {
    double sum = 0.0;
    for (int k = 1; k <= kHarmonics; ++k) {
      const auto of_side = [&](double side) {
        return std::abs(choice.averages->harmonic({side * scale}, k));
      };
      sum += 2.0 * kept(fade, count, cell_of(i), of_side);
    }
    most = std::max(most, sum);
  }
  return 3.0 * most * std::pow(scale, dimensions) /
         (density() * squared(choice.moments.second * fade.second_moment));
}

ScaleLayout scale_layout(const StrataChoice& choice, double density, ImpulseSpread spread) {
  const int n = choice.dimensions;
  const ScaleFade fade(n);
  if (spread == ImpulseSpread::poisson) {
    if (density == 0.0) density = choice.poisson_density();
    const double made = 1.0 - fade.lowest;  // of all turns
    const double count = density * std::pow(choice.radius, n) * fade.impulses_per_effective_one * made;
    return {n, choice.radius, {count, false}};
  }
  const double smallest = 2.0 * choice.smallest_cell();  // a grid's kernels are up to two scales large
  const double side = choice.balanced_side();
  const int most_halvings = density == 0.0 || side < smallest ? StrataChoice::kMostHalvings : 1;
  ScaleLayout layout{n, 0.0};
  for (int halvings = 1; halvings <= most_halvings && layout.scale < smallest; ++halvings) {
    layout.count = {std::exp2(n * halvings), true, halvings};
    layout.scale = density > 0.0 ? scale_of_density(layout, density) : default_scale(choice, layout);
  }
  const double least = density > 0.0 ? std::max(side, smallest) : smallest;
  if (layout.scale < least) {
    layout.count = {std::ceil(layout.count.mean * std::pow(least / layout.scale, n)), true};
    layout.scale = least;
  }
  return layout;
}

}  // namespace solidnoise
