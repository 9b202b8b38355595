#include "solidnoise/volume/topology/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace solidnoise {
namespace {

using Edge = std::array<std::uint32_t, 2>;

void require_usable_arrays(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("the mesh is empty: it has no faces");
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh.positions.size()) {
        throw std::invalid_argument(fmt::format("the mesh has a face with vertex {}, but only {} vertices",
                                                corner, mesh.positions.size()));
      }
      const Vec<3>& p = mesh.positions[corner];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        throw std::invalid_argument(fmt::format("the mesh's vertex {} is not finite", corner));
      }
    }
  }
}

// For each vertex, the first one of those at its position.
std::vector<std::uint32_t> weld(const std::vector<Vec<3>>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    return std::make_tuple(positions[v].x, positions[v].y, positions[v].z, v);
  };
  // A position that no face uses may be not-a-number, which has no place in an order.
  std::erase_if(order, [&](std::uint32_t v) {
    return std::isnan(positions[v].x) || std::isnan(positions[v].y) || std::isnan(positions[v].z);
  });
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Every triangle's edges, smaller vertex first, sorted.
std::vector<Edge> sorted_edges(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> welded = weld(mesh.positions);
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    const Triangle t{welded[triangle[0]], welded[triangle[1]], welded[triangle[2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const auto [low, high] = std::minmax(t[corner], t[(corner + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

Box<3> TriangleMesh::bounds() const {
  Box<3> box{positions[triangles[0][0]], positions[triangles[0][0]]};
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t corner : triangle) {
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], positions[corner][axis]);
        box.upper[axis] = std::max(box.upper[axis], positions[corner][axis]);
      }
    }
  }
  return box;
}

void require_closed(const TriangleMesh& mesh) {
  require_usable_arrays(mesh);
  const std::vector<Edge> edges = sorted_edges(mesh);
  if (edges.empty()) throw std::invalid_argument("the mesh is empty: all its faces are degenerate");

  std::size_t bad = 0;
  Edge first_bad{};
  std::size_t first_bad_count = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin == 2) continue;
    if (bad == 0) {
      first_bad = edges[begin];
      first_bad_count = end - begin;
    }
    ++bad;
  }
  if (bad == 0) return;
  const Vec<3>& a = mesh.positions[first_bad[0]];
  const Vec<3>& b = mesh.positions[first_bad[1]];
  throw std::invalid_argument(fmt::format(
      "the mesh is not closed: the edge from ({:.6g} {:.6g} {:.6g}) to ({:.6g} {:.6g} {:.6g}) belongs to "
      "{} triangle{}, and {} edge{} in all {} not between exactly two",
      a.x, a.y, a.z, b.x, b.y, b.z, first_bad_count, first_bad_count == 1 ? "" : "s", bad,
      bad == 1 ? "" : "s", bad == 1 ? "is" : "are"));
}

}  // namespace solidnoise
