#pragma once

#include <span>

#include <glm/common.hpp>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// The least box that holds all positions; {0, 0} where there are none.
template <int Dim>
Box<Dim> bounds_of(std::span<const Vec<Dim>> positions) {
  if (positions.empty()) return {};
  Box<Dim> box{positions.front(), positions.front()};
  for (const Vec<Dim>& position : positions)
    box = {glm::min(box.lower, position), glm::max(box.upper, position)};
  return box;
}

// The numbers that a box is made of, as tables of fields have them (core/fields.h).
template <int Dim, typename Visit>
void for_each_number(const Box<Dim>& box, const Visit& visit) {
  for (int axis = 0; axis < Dim; ++axis) visit(box.lower[axis]);
  for (int axis = 0; axis < Dim; ++axis) visit(box.upper[axis]);
}

}  // namespace solidnoise
