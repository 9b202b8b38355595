#include "solidnoise/field/normalization.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solidnoise/core/moments.h"

namespace solidnoise {
namespace {

constexpr double kSamplesPerWave = 2.5;
constexpr double kFewestSamples = 16.0;  // along an axis

template <int Dim>
Lattice<Dim> midpoints_of(const Box<Dim>& box, double highest_frequency) {
  const double most = std::floor(std::pow(kMostNormalizationSamples, 1.0 / Dim));
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    const double side = box.upper[axis] - box.lower[axis];
    lattice.count[axis] = static_cast<int>(
        std::clamp(std::ceil(kSamplesPerWave * highest_frequency * side), kFewestSamples, most));
    lattice.step[axis] = side / lattice.count[axis];
    lattice.origin[axis] = box.lower[axis] + 0.5 * lattice.step[axis];
  }
  return lattice;
}

}  // namespace

template <int Dim>
Normalization normalization_in(const Noise<Dim>& noise, const Box<Dim>& box, const Vec<4>& period) {
  Box<Dim> region = box;
  for (int axis = 0; axis < Dim; ++axis) {
    if (period[axis] == 0.0) continue;
    region.lower[axis] = 0.0;
    region.upper[axis] = period[axis];
  }
  const Lattice<Dim> lattice = midpoints_of(region, noise.band().upper);
  std::vector<float> values(lattice.size());
  noise.block(lattice.bounds())->evaluate(lattice, Samples<Dim>{values, {}});
  const Moments moments = Moments::of(values);
  const double scale = moments.sigma() > 0.0 ? std::sqrt(noise.variance()) / moments.sigma() : 1.0;
  return {static_cast<float>(scale), static_cast<float>(-scale * moments.mean())};
}

template Normalization normalization_in(const Noise<1>&, const Box<1>&, const Vec<4>&);
template Normalization normalization_in(const Noise<2>&, const Box<2>&, const Vec<4>&);
template Normalization normalization_in(const Noise<3>&, const Box<3>&, const Vec<4>&);

}  // namespace solidnoise
