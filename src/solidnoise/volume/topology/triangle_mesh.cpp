#include "solidnoise/volume/topology/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/named_error.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/same_places.h"

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

// Every triangle's edges, smaller vertex first, sorted.
std::vector<Edge> sorted_edges(const TriangleMesh& mesh, const std::vector<std::uint32_t>& welded) {
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

// Edges that are not between two triangles, of which there are so many.
struct BadEdge {
  Edge edge;
  std::size_t triangles = 0;
};
std::vector<BadEdge> bad_edges(const std::vector<Edge>& edges) {
  std::vector<BadEdge> bad;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin != 2) bad.push_back({edges[begin], end - begin});
  }
  return bad;
}

// Joins the vertices at these edges that rounding puts apart.
void join_seams(const TriangleMesh& mesh, const std::vector<BadEdge>& bad,
                std::vector<std::uint32_t>& welded) {
  const Box<3> box = mesh.bounds();
  const Vec<3> sides = box.upper - box.lower;
  std::vector<double> gaps(mesh.positions.size());
  for (const auto& [edge, triangles] : bad) {
    const double length = glm::distance(mesh.positions[edge[0]], mesh.positions[edge[1]]);
    for (const std::uint32_t vertex : edge)
      gaps[vertex] = std::max(gaps[vertex], seam_gap(std::max({sides.x, sides.y, sides.z}), length));
  }
  const std::vector<std::uint32_t> joined = first_across_gap(mesh.positions, gaps);
  for (std::uint32_t& vertex : welded) {
    while (joined[vertex] != vertex) vertex = joined[vertex];
  }
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
  std::vector<std::uint32_t> welded = first_at_position(mesh.positions);
  const std::vector<Edge> edges = sorted_edges(mesh, welded);
  if (edges.empty()) throw std::invalid_argument("the mesh is empty: all its faces are degenerate");

  std::vector<BadEdge> all_bad = bad_edges(edges);
  if (all_bad.empty()) return;
  join_seams(mesh, all_bad, welded);
  all_bad = bad_edges(sorted_edges(mesh, welded));
  if (all_bad.empty()) return;
  const std::size_t bad = all_bad.size();
  const auto& [first_bad, first_bad_count] = all_bad.front();
  const Vec<3>& a = mesh.positions[first_bad[0]];
  const Vec<3>& b = mesh.positions[first_bad[1]];
  throw std::invalid_argument(fmt::format(
      "the mesh is not closed: the edge from ({:.6g} {:.6g} {:.6g}) to ({:.6g} {:.6g} {:.6g}) belongs to "
      "{} triangle{}, and {} edge{} in all {} not between exactly two",
      a.x, a.y, a.z, b.x, b.y, b.z, first_bad_count, first_bad_count == 1 ? "" : "s", bad,
      bad == 1 ? "" : "s", bad == 1 ? "is" : "are"));
}

TriangleMesh read_closed_mesh(const std::string& file) {
  PolygonMesh mesh = read_mesh(file).mesh;
  TriangleMesh result{std::move(mesh.positions), triangulate(mesh)};
  in_file(file, [&] { require_closed(result); });
  return result;
}

}  // namespace solidnoise
