#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solidnoise/core/field.h"

namespace solidnoise {

// All channels of a field at one position.
inline std::vector<float> channels_at(const Field<3>& field, const Vec<3>& position) {
  Lattice<3> lattice;
  lattice.origin = position;
  std::vector<float> values(static_cast<std::size_t>(field.channels()));
  field.block({position, position})->evaluate(lattice, {values, {}});
  return values;
}

// The first three channels.
inline Vec<3> vector_at(const Field<3>& field, const Vec<3>& position) {
  const std::vector<float> values = channels_at(field, position);
  return {values.at(0), values.at(1), values.at(2)};
}

// All channels of a field on a lattice, one after the other.
inline std::vector<float> channels_on(const Field<3>& field, const Lattice<3>& lattice) {
  std::vector<float> values(static_cast<std::size_t>(field.channels()) * lattice.size());
  field.block(lattice.bounds())->evaluate(lattice, {values, {}});
  return values;
}

// The divergence of a function of position, by central differences of second order.
template <typename Function>
double divergence(const Function& vector, const Vec<3>& position, double step) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Vec<3> shift(0.0);
    shift[axis] = step;
    sum += (vector(position + shift)[axis] - vector(position - shift)[axis]) / (2.0 * step);
  }
  return sum;
}

}  // namespace solidnoise
