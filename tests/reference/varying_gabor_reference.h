#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "reference/gabor_kernels.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_process.h"

// Gabor noise whose kernel belongs to the evaluation point, as it is defined: one point, one impulse at a
// time, in double precision. It has in common with the library the random numbers only.
namespace solidnoise::reference {

template <int Dim>
struct VaryingSetting {
  double impulses = 20.0;  // N, or of one grid those of a cell
  double nominal = 1.0;    // the radius that N and a layer's thickness are measured by, in radii
  double scale = 0.0;      // that tells the level of grids in strata, in radii; 0: a Poisson process
  ImpulseCount count{};    // of the cells of strata, of one grid or of more
  double layer = 0.0;      // half thickness of a surface's layer, in nominal radii; 0: the kernel is a ball
  double side = 0.0;       // of the cells of one grid in strata, in world units; 0: a hierarchy of grids
  std::uint64_t seed = 0;
};

template <int Dim>
struct VaryingPoint {
  Position<Dim> position{};
  double radius = 1.0;
  Position<Dim> normal{};                                     // of a surface, in 3D
  std::function<double(const Position<Dim>& offset)> kernel;  // 0 from the radius on
  double energy = 1.0;  // integral of its square, over space or over the tangent plane
};

inline double smooth_step(double x) {
  return x <= 0.0 ? 0.0 : x >= 1.0 ? 1.0 : x * x * (3.0 - 2.0 * x);
}

// The window of a layer and the integral of its square.
inline double window(double u) {
  return std::abs(u) < 1.0 ? std::pow(1.0 - u * u, 2) : 0.0;
}
inline constexpr double kWindowPower = 256.0 / 315.0;

// Ramps up from 2^-n over half of that, down over the last quarter.
template <int Dim>
double fade(double y) {
  const double lowest = std::pow(0.5, Dim);
  return smooth_step(std::fmin((y - lowest) / (0.5 * lowest), (1.0 - y) / 0.25));
}

// Integral over y of fade^power, by the midpoint rule.
template <int Dim>
double fade_moment(int power) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += std::pow(fade<Dim>((i + 0.5) / kSteps), power);
  return sum / kSteps;
}

template <int Dim>
class VaryingGaborProcedure {
 public:
  explicit VaryingGaborProcedure(const VaryingSetting<Dim>& setting) : setting_(setting) {
    const double ball = std::array{0.0, 2.0, std::numbers::pi, 4.0 * std::numbers::pi / 3.0,
                                   std::numbers::pi * std::numbers::pi / 2.0}[Dim];
    const double support = setting.layer > 0.0 ? 2.0 * std::numbers::pi * setting.layer : ball;
    scale_ = setting.scale > 0.0 ? setting.scale : setting.nominal;
    density_ = setting.impulses / support * std::pow(scale_ / setting.nominal, Dim);
    second_ = fade_moment<Dim>(2);
    density_ *= fade_moment<Dim>(4) / (second_ * second_);
    if (setting.scale > 0.0) density_ = setting.count.mean / kMade;
  }

  // Of unit variance.
  double operator()(const VaryingPoint<Dim>& point) const {
    double energy = point.energy;
    double reach = 1.0;
    if (setting_.layer > 0.0) {
      energy *= kWindowPower * setting_.layer * setting_.nominal * point.radius;
      reach = std::hypot(1.0, setting_.layer * setting_.nominal);
    }
    if (setting_.side > 0.0) {
      const double density = setting_.count.mean / std::pow(setting_.side, Dim);
      return sum_of_grid(point, grid(0, setting_.side, setting_.count.mean), reach) /
             std::sqrt(density * energy);
    }
    const double scale = scale_ * point.radius;
    const double amplitude = 1.0 / std::sqrt(density_ / std::pow(scale, Dim) * second_ * energy);
    const int level = static_cast<int>(std::floor(std::log2(scale)));
    double sum = 0.0;
    for (const int step : {0, 1}) {
      sum += sum_of_grid(point, grid(level + step, std::exp2(level + step), density_ * kMade), reach);
    }
    return amplitude * sum;
  }

 private:
  static constexpr double kMade = 1.0 - 1.0 / (1 << Dim);  // of all turns

  ImpulseProcess<Dim> grid(int level, double size, double mean) const {
    std::array<CellAxis, Dim> axes;
    axes.fill(CellAxis(size));
    // Keys: stream 1 of the seed, and of that one stream per level from 2^20 on.
    const std::uint64_t key =
        derive_seed(derive_seed(setting_.seed, 1), (1u << 20) + static_cast<std::uint64_t>(level));
    if (setting_.count.is_fixed) return ImpulseProcess<Dim>(axes, setting_.count, key);
    return ImpulseProcess<Dim>(axes, {mean, false}, key);
  }

  double sum_of_grid(const VaryingPoint<Dim>& point, const ImpulseProcess<Dim>& process, double reach) const {
    const double size = process.axes()[0].size();
    Index<Dim> first, last;
    for (int axis = 0; axis < Dim; ++axis) {
      first[axis] =
          static_cast<std::int64_t>(std::floor((point.position[axis] - reach * point.radius) / size)) -
          (process.span() - 1);
      last[axis] =
          static_cast<std::int64_t>(std::floor((point.position[axis] + reach * point.radius) / size));
    }
    double sum = 0.0;
    Index<Dim> cell = first;
    while (true) {
      process.generate(
          cell, [&](const solidnoise::Impulse<Dim>& impulse) { sum += term(point, cell, size, impulse); });
      int axis = Dim - 1;
      while (axis >= 0 && ++cell[axis] > last[axis]) {
        cell[axis] = first[axis];
        --axis;
      }
      if (axis < 0) return sum;
    }
  }

  double term(const VaryingPoint<Dim>& point, const Index<Dim>& cell, double size,
              const solidnoise::Impulse<Dim>& impulse) const {
    Position<Dim> offset;
    double height = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      const double fraction = impulse.position[axis] / static_cast<double>(CellAxis::kQuantaPerCell);
      offset[axis] = point.position[axis] - (static_cast<double>(cell[axis]) + fraction) * size;
      height += offset[axis] * point.normal[axis];
    }
    double factor = impulse.mark >> 63 ? 1.0 : -1.0;
    if (setting_.layer > 0.0) {
      for (int axis = 0; axis < Dim; ++axis) offset[axis] -= height * point.normal[axis];
      factor *= window(height / (setting_.layer * setting_.nominal * point.radius));
    }
    if (setting_.side == 0.0) {
      const double share = static_cast<double>(impulse.mark & 0xffffffu) / 0x1p24;
      const double lowest = std::exp2(-Dim);
      factor *= fade<Dim>(std::pow(scale_ * point.radius / size, Dim) * (lowest + (1.0 - lowest) * share));
    }
    return factor * point.kernel(offset);
  }

  VaryingSetting<Dim> setting_;
  double scale_;    // the length that cells follow, in radii
  double density_;  // impulses per cube of that side
  double second_;   // integral of fade^2
};

}  // namespace solidnoise::reference
