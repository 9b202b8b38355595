#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Values and derivatives of the samples of a lattice or of points.
template <int Dim>
struct Evaluated {
  std::vector<float> values;
  std::array<std::vector<float>, Dim> gradient;

  explicit Evaluated(std::size_t count) : values(count) {
    for (auto& derivative : gradient) derivative.resize(count);
  }
  Samples<Dim> samples() {
    Samples<Dim> spans{values, {}};
    for (std::size_t axis = 0; axis < Dim; ++axis) spans.gradient[axis] = gradient[axis];
    return spans;
  }
  friend bool operator==(const Evaluated&, const Evaluated&) = default;
};

template <int Dim>
Evaluated<Dim> evaluate_in_one_block(const Noise<Dim>& noise, const Lattice<Dim>& lattice) {
  Evaluated<Dim> result(lattice.size());
  noise.block(lattice.bounds())->evaluate(lattice, result.samples());
  return result;
}

// The position of a lattice's sample, by its place in the storage order.
template <int Dim>
Vec<Dim> sample_position(const Lattice<Dim>& lattice, std::size_t sample) {
  Vec<Dim> position;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const std::size_t count = static_cast<std::size_t>(lattice.count[axis]);
    position[axis] = lattice.coordinate(axis, static_cast<std::int64_t>(sample % count));
    sample /= count;
  }
  return position;
}

}  // namespace solidnoise
