#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/points.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/point/point_parameters.h"

namespace solidnoise {

// Scattered points with parameters and normals, as the noises take them.
template <int Dim>
struct Scattered {
  Vec<Dim> origin{0.0};
  std::array<std::vector<float>, Dim> offset;
  std::vector<float> frequency, bandwidth, magnitude;
  std::array<std::vector<float>, Dim> direction;
  std::array<std::vector<float>, 3> normal;

  std::size_t size() const { return offset[0].size(); }

  // Of positions that stay where they are until the next call.
  Points<Dim> points() const {
    positions_.assign(size(), origin);
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (std::size_t i = 0; i < size(); ++i) positions_[i][static_cast<int>(axis)] += offset[axis][i];
    }
    return {positions_};
  }
  SurfacePoints surface() const { return {points(), {normal[0], normal[1], normal[2]}}; }
  VaryingParameters<Dim> parameters() const {
    VaryingParameters<Dim> result{frequency, bandwidth, magnitude, {}};
    for (std::size_t axis = 0; axis < Dim; ++axis) result.direction[axis] = direction[axis];
    return result;
  }

  // Some of the points, in the order of their numbers.
  Scattered picked(std::span<const std::size_t> numbers) const {
    Scattered result;
    result.origin = origin;
    const auto take = [&](const std::vector<float>& from, std::vector<float>& to) {
      to = pick(from, numbers);
    };
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      take(offset[axis], result.offset[axis]);
      take(direction[axis], result.direction[axis]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) take(normal[axis], result.normal[axis]);
    take(frequency, result.frequency);
    take(bandwidth, result.bandwidth);
    take(magnitude, result.magnitude);
    return result;
  }

 private:
  mutable std::vector<Vec<Dim>> positions_;
};

// Uniform on the unit sphere.
template <int Dim>
std::array<float, Dim> random_direction(RandomStream& random) {
  while (true) {
    std::array<double, Dim> v;
    double square = 0.0;
    for (double& component : v) {
      component = 2.0 * random.next_unit() - 1.0;
      square += component * component;
    }
    if (square > 1.0 || square < 0.01) continue;
    std::array<float, Dim> unit;
    for (std::size_t axis = 0; axis < Dim; ++axis)
      unit[axis] = static_cast<float>(v[axis] / std::sqrt(square));
    return unit;
  }
}

// Points all over a cube around the origin, with parameters of a wide range that know nothing of each other.
// The coordinates are multiples of 2^-12, so that adding a large origin changes no digit.
template <int Dim>
Scattered<Dim> scattered_points(std::size_t count, double side, std::uint64_t seed = 1) {
  RandomStream random(seed);
  Scattered<Dim> result;
  for (std::size_t i = 0; i < count; ++i) {
    for (auto& coordinates : result.offset) {
      coordinates.push_back(
          static_cast<float>(std::round((random.next_unit() - 0.5) * side * 4096.0) / 4096.0));
    }
    result.frequency.push_back(static_cast<float>(std::exp2(4.0 * random.next_unit() - 2.0)));
    result.bandwidth.push_back(static_cast<float>(std::exp2(2.5 * random.next_unit() - 1.0)));
    result.magnitude.push_back(static_cast<float>(0.5 + random.next_unit()));
    const auto direction = random_direction<Dim>(random);
    for (std::size_t axis = 0; axis < Dim; ++axis) result.direction[axis].push_back(direction[axis]);
    const auto normal = random_direction<3>(random);
    for (std::size_t axis = 0; axis < 3; ++axis) result.normal[axis].push_back(normal[axis]);
  }
  return result;
}

}  // namespace solidnoise
