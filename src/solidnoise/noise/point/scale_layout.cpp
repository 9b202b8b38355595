#include "solidnoise/noise/point/scale_layout.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/point/scale_fade.h"

namespace solidnoise {
namespace {

// What strata keep of the integral of fade^4 over the turns of a grid whose cells are `cell` scales large: in
// halves of cells, and in whole ones.
struct FadedShares {
  FadedShares(const ScaleFade& fade, const ImpulseCount& count, double cell) {
    constexpr int kSteps = 32;  // of a part
    const int parts = static_cast<int>(count.mean);
    const double densest = std::pow(cell, -fade.dimensions);  // y where u is 1
    const double all = densest * (1.0 - fade.lowest);
    double mean = 0.0;
    double squares = 0.0;
    for (int k = 0; k < parts; ++k) {
      double of_part = 0.0;
      for (int step = 0; step < kSteps; ++step) {
        of_part += squared(fade(densest * fade.lowest + all * (k + (step + 0.5) / kSteps) / parts)) / kSteps;
      }
      mean += of_part / parts;
      squares += squared(of_part) / parts;
    }
    in_cells = all * squares;
    if (!count.in_orthants) return;
    const double variance = (squares - squared(mean)) / (parts - 1);
    in_halves = all * (squared(mean) - variance);
    in_cells = all * parts * variance;
  }

  double in_halves = 0.0;
  double in_cells = 0.0;
};

// Of both grids of a level whose cells are `cell` scales large, and the next's twice that, what strata keep
// of the integral of fade^4 times what cubes of a side, in scales, keep of the kernel's.
double kept(const ScaleFade& fade, const ImpulseCount& count, double cell,
            const std::function<double(double)>& of_side) {
  const FadedShares fine(fade, count, cell);
  const FadedShares coarse(fade, count, 2.0 * cell);
  return fine.in_halves * of_side(0.5 * cell) + (fine.in_cells + coarse.in_halves) * of_side(cell) +
         coarse.in_cells * of_side(2.0 * cell);
}

// The cells of the levels of some scales, over these: evenly over the octave that has one level.
constexpr int kScales = 8;
double cell_of(int i) {
  return std::exp2(-(i + 0.5) / kScales);
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
    const auto of_side = [&](double side) { return choice.averages->overlap(side * scale); };
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
      const auto of_side = [&](double side) { return std::abs(choice.averages->harmonic(side * scale, k)); };
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
    if (density == 0.0) {
      density = density_for_excess_kurtosis(kDefaultKurtosis, choice.moments, choice.weights);
    }
    const double made = 1.0 - fade.lowest;  // of all turns
    const double count = density * std::pow(choice.radius, n) * fade.impulses_per_effective_one * made;
    return {n, choice.radius, {count, false}};
  }
  ScaleLayout layout{n, choice.radius, {std::exp2(n), true, true}};
  const auto scale_of_density = [&](double effective) {
    return std::pow(layout.density() / (effective * fade.impulses_per_effective_one), 1.0 / n);
  };
  if (density > 0.0) {
    layout.scale = scale_of_density(density);
    const double side = choice.balanced_side();
    if (layout.scale < side) {
      layout.count = {std::ceil(layout.count.mean * std::pow(side / layout.scale, n)), true};
      layout.scale = side;
    }
    return layout;
  }
  constexpr double kMostOverStationary = 2.0;
  const double least = std::max(scale_of_density(kMostOverStationary * choice.most_density()),
                                2.0 * choice.radius / StrataChoice::kMostCubes);
  layout.scale = balanced_side(
      [&](double scale) {
        layout.scale = scale;
        return layout.excess_kurtosis(choice, choice.moments);
      },
      least, 8.0 * choice.radius);
  return layout;
}

}  // namespace solidnoise
