#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "solidnoise/noise/cellular/cellular_noise.h"

namespace solidnoise::reference {

// Cellular noise point by point, in double precision, as Worley 1996 says: all points of the cells around a
// place are looked at, three cells far, and the two nearest kept. The points are those of the noise.
template <int Dim>
class CellularProcedure {
 public:
  explicit CellularProcedure(const CellularNoise<Dim>& noise)
      : points_(noise.points()), options_(noise.options()), statistics_(options_.feature) {}

  double operator()(const std::array<double, Dim>& at) const {
    Vec<Dim> position;
    for (std::size_t axis = 0; axis < Dim; ++axis) position[static_cast<int>(axis)] = at[axis];
    return value(position);
  }

  double value(const Vec<Dim>& position) const {
    const Nearest nearest = find(position);
    const bool border = options_.feature == CellularNoiseOptions::Feature::border;
    const double feature =
        border ? glm::length(nearest.second) - glm::length(nearest.first) : glm::length(nearest.first);
    return (feature * options_.frequency - statistics_.mean()) / std::sqrt(statistics_.variance());
  }

  Vec<Dim> gradient(const Vec<Dim>& position) const {
    const Nearest nearest = find(position);
    const bool border = options_.feature == CellularNoiseOptions::Feature::border;
    const Vec<Dim> slope = border ? glm::normalize(nearest.second) - glm::normalize(nearest.first)
                                  : glm::normalize(nearest.first);
    return slope * (options_.frequency / std::sqrt(statistics_.variance()));
  }

  // How much farther the third nearest point is than the second, and the second than the first: where that is
  // next to nothing a gradient jumps.
  double clearance(const Vec<Dim>& position) const {
    const Nearest nearest = find(position);
    const double first = glm::length(nearest.first);
    const double second = glm::length(nearest.second);
    return std::min({first, second - first, glm::length(nearest.third) - second});
  }

 private:
  // Offsets from the nearest points.
  struct Nearest {
    Vec<Dim> first{1e9};
    Vec<Dim> second{1e9};
    Vec<Dim> third{1e9};
  };

  Nearest find(const Vec<Dim>& position) const {
    constexpr std::int64_t kCells = 3;
    Index<Dim> middle;
    for (int axis = 0; axis < Dim; ++axis) middle[axis] = points_.axes()[axis].locate(position[axis]).cell;
    Nearest nearest;
    Index<Dim> cell = middle - kCells;
    do {
      points_.generate(cell, [&](const solidnoise::Impulse<Dim>& point) {
        Vec<Dim> offset;
        for (int axis = 0; axis < Dim; ++axis) {
          const double place = std::ldexp(point.position[axis], -CellAxis::kFractionBits);
          offset[axis] =
              position[axis] - (static_cast<double>(cell[axis]) + place) * points_.axes()[axis].size();
        }
        const double square = glm::dot(offset, offset);
        if (square < glm::dot(nearest.first, nearest.first)) {
          nearest.third = nearest.second;
          nearest.second = nearest.first;
          nearest.first = offset;
        } else if (square < glm::dot(nearest.second, nearest.second)) {
          nearest.third = nearest.second;
          nearest.second = offset;
        } else if (square < glm::dot(nearest.third, nearest.third)) {
          nearest.third = offset;
        }
      });
    } while (next_cell<Dim>(cell, middle - kCells, middle + kCells));
    return nearest;
  }

  ImpulseProcess<Dim> points_;
  CellularNoiseOptions options_;
  CellularStatistics<Dim> statistics_;
};

}  // namespace solidnoise::reference
