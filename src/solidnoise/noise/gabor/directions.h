#pragma once

#include <array>
#include <vector>

#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/wave_mixture.h"

namespace solidnoise {

// Random directions of waves in Dim dimensions (a direction and its opposite are the same wave): uniform over
// the double cone around an axis that takes up the fraction 1 - anisotropy of the sphere. With anisotropy 0
// that is the whole sphere, and the mean of d d^T is I / Dim; with 1 it is the axis alone.
template <int Dim>
class DirectionCone {
 public:
  // `axis` not 0; anisotropy 0 to 1.
  DirectionCone(const Vec<Dim>& axis, double anisotropy);

  const Vec<Dim>& axis() const { return axis_; }  // of unit length
  double anisotropy() const { return anisotropy_; }

  // For a uniform `share` in [0, 1), and from a stream what else it takes. Shares apart are directions apart:
  // in two dimensions the share is the angle, from one edge of the cone to the other, in more the angle from
  // the axis.
  Vec<Dim> draw(double share, RandomStream& stream) const;

  // Directions and weights of a quadrature over the cone, for functions that a direction and its opposite
  // have in common; of the whole sphere, mirrored_directions().
  std::vector<WeightedDirection<Dim>> quadrature() const;

  // The mean of d_i^2 for each coordinate; the sum of all is 1.
  Vec<Dim> second_moments() const;

  // An angle from the axis.
  struct Polar {
    double cosine = 1.0;
    double sine = 0.0;
  };

  // The angle below which lies the fraction `share` of the cone.
  Polar polar_angle(double share) const;

  // The direction at an angle from the axis, around it at the direction `around` of Dim - 1 coordinates, of
  // unit length.
  Vec<Dim> at(const Polar& polar, const std::array<double, 3>& around) const;

 private:
  Vec<Dim> axis_;
  double anisotropy_;
  Vec<Dim> mirror_;  // reflection that takes the first axis to axis_: x - 2 (x.m) m; 0 for none
};

}  // namespace solidnoise
