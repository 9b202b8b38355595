#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Points on surfaces, with the surface's normals: any length but 0, either sign, one float per point and
// axis. They should be smooth (interpolated) normals: noises on surfaces are continuous in the normal, and
// have seams where that has.
struct SurfacePoints {
  Points<3> positions;
  std::array<std::span<const float>, 3> normal;

  // Throws std::invalid_argument naming the first point whose position is not finite or whose normal has no
  // direction.
  void validate() const;
};

// A direction laid into the tangent plane of a unit normal, of unit length; some tangent where it is along
// the normal, as far as single precision tells.
Vec<3> unit_tangent(const Vec<3>& direction, const Vec<3>& normal);

inline constexpr double kMostMagnitude = 1e12;

// Parameters that a noise has at each evaluation point, one float per point. Where a span is empty, the
// noise's options hold for all points.
template <int Dim>
struct VaryingParameters {
  std::span<const float> frequency;  // principal frequency F0, cycles per world unit; of kFrequencies
  std::span<const float> bandwidth;  // octaves; 0.1 to 4
  std::span<const float> magnitude;  // standard deviation of the value; 0 to kMostMagnitude
  // Along which the waves of an oriented kernel travel; either sign: a direction and its opposite give the
  // same value. Where it is 0 (or, on a surface, along the normal) an arbitrary direction is taken. In a
  // volume of any length; on a surface one shorter than 1 is unsure (SurfaceGaborNoise). All empty, or none.
  std::array<std::span<const float>, Dim> direction;

  // Throws std::invalid_argument naming the first point whose parameter is not allowed, its value and what is
  // allowed; or a span whose size is not `count`.
  void validate(std::size_t count) const;

  bool radius_varies() const { return !frequency.empty() || !bandwidth.empty(); }
};

// Numbers of some of the points, side by side. Far-apart memory is read here, array by array: the processor
// then waits for many places at once.
std::vector<float> pick(std::span<const float> from, std::span<const std::size_t> points);
template <std::size_t kCount>
std::array<std::vector<float>, kCount> pick(const std::array<std::span<const float>, kCount>& from,
                                            std::span<const std::size_t> points) {
  std::array<std::vector<float>, kCount> picked;
  for (std::size_t i = 0; i < kCount; ++i) picked[i] = pick(from[i], points);
  return picked;
}

// The parameters of some of the points; the accessors take the options' value in case that there are none.
template <int Dim>
class PickedParameters {
 public:
  PickedParameters(const VaryingParameters<Dim>& parameters, std::span<const std::size_t> points)
      : frequency_(pick(parameters.frequency, points)),
        bandwidth_(pick(parameters.bandwidth, points)),
        magnitude_(pick(parameters.magnitude, points)),
        direction_(pick(parameters.direction, points)) {}

  bool varies_bandwidth() const { return !bandwidth_.empty(); }
  double frequency(std::size_t i, double constant) const { return at(frequency_, i, constant); }
  double bandwidth(std::size_t i, double constant) const { return at(bandwidth_, i, constant); }
  double magnitude(std::size_t i, double constant) const { return at(magnitude_, i, constant); }
  Vec<Dim> direction(std::size_t i, const Vec<Dim>& constant) const {
    Vec<Dim> result;
    for (int axis = 0; axis < Dim; ++axis) {
      result[axis] = at(direction_[static_cast<std::size_t>(axis)], i, constant[axis]);
    }
    return result;
  }

 private:
  static double at(const std::vector<float>& values, std::size_t i, double constant) {
    return values.empty() ? constant : static_cast<double>(values[i]);
  }

  std::vector<float> frequency_;
  std::vector<float> bandwidth_;
  std::vector<float> magnitude_;
  std::array<std::vector<float>, Dim> direction_;
};

// Throws std::invalid_argument naming the first point whose position is not finite.
template <int Dim>
void require_finite_positions(const Points<Dim>& points);

}  // namespace solidnoise
