#pragma once

#include <cstdint>

#include <glm/detail/qualifier.hpp>
#include <glm/ext/vector_double1.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace solidnoise {

// A position, size or frequency in Dim dimensions, in double precision. In 4D the axes are x, y, z, t.
template <int Dim>
using Vec = glm::vec<Dim, double, glm::defaultp>;

// An integer position: a voxel's index, a cell's coordinates.
template <int Dim>
using Index = glm::vec<Dim, std::int64_t, glm::defaultp>;

template <int Dim>
double squared_length(const Vec<Dim>& x) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += x[axis] * x[axis];
  return sum;
}

// An axis-aligned box in world units; both corners belong to it.
template <int Dim>
struct Box {
  Vec<Dim> lower{0.0};
  Vec<Dim> upper{0.0};
};

}  // namespace solidnoise
