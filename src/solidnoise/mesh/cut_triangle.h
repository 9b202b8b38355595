#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/refine.h"

namespace solidnoise {

inline constexpr std::uint32_t kWhole =
    std::numeric_limits<std::uint32_t>::max();  // an edge without a middle

// The parts of a triangle v0 v1 v2 whose edge from v_k on is split at middles[k], or is whole: one more than
// there are middles, all wound as the triangle is. `place` gives a vertex's position.
template <typename Place>
std::array<Triangle, 4> cut_triangle(const Triangle& triangle, const std::array<std::uint32_t, 3>& middles,
                                     const Place& place) {
  const auto is_split = [&](std::size_t k) { return middles[k % 3] != kWhole; };
  const auto count = is_split(0) + is_split(1) + is_split(2);
  if (count == 0) return {triangle};
  // Turn it so that the first of one, or of two in a row, is m0.
  std::size_t turn = 0;
  while (!is_split(turn) || (count == 2 && !is_split(turn + 1))) ++turn;
  const auto corner = [&](std::size_t k) { return triangle[(k + turn) % 3]; };
  const auto middle = [&](std::size_t k) { return middles[(k + turn) % 3]; };
  const std::uint32_t v0 = corner(0);
  const std::uint32_t v1 = corner(1);
  const std::uint32_t v2 = corner(2);
  const std::uint32_t m0 = middle(0);
  const std::uint32_t m1 = middle(1);
  const std::uint32_t m2 = middle(2);
  if (count == 1) return {{{v0, m0, v2}, {m0, v1, v2}}};
  if (count == 3) return {{{v0, m0, m2}, {m0, v1, m1}, {m2, m1, v2}, {m0, m1, m2}}};
  if (glm::distance(place(v0), place(m1)) <= glm::distance(place(m0), place(v2))) {
    return {{{m0, v1, m1}, {v0, m0, m1}, {v0, m1, v2}}};
  }
  return {{{m0, v1, m1}, {v0, m0, v2}, {m0, m1, v2}}};
}

// How many triangles refine() makes of a mesh, without making any, or infinity if they are more than `most`:
// by `own` with new vertices on the edges, and by `loop` and `sqrt3`, exactly; `longest_edge` makes about as
// many as `own`. `targets` has a length for every vertex.
double refined_faces(const PolygonMesh& mesh, const std::vector<double>& targets,
                     const RefineOptions& options, double most);

}  // namespace solidnoise
