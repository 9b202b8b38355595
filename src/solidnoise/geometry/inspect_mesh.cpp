#include "solidnoise/geometry/inspect_mesh.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/adjacency.h"
#include "solidnoise/core/bounds.h"

namespace solidnoise {
namespace {

void count_edges(const PolygonMesh& mesh, MeshReport& report) {
  // The faces' edges by their smaller vertices: twice the larger one, and 1 more where the face goes to it.
  std::vector<std::uint32_t> smaller;
  std::vector<std::uint64_t> larger;
  smaller.reserve(mesh.corners.size());
  larger.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size() && face.size() > 1; ++k) {
      const std::uint32_t a = face[k];
      const std::uint32_t b = face[k + 1 < face.size() ? k + 1 : 0];
      if (a == b) continue;
      smaller.push_back(std::min(a, b));
      larger.push_back(2 * std::uint64_t{std::max(a, b)} + (a < b ? 1 : 0));
    }
  }
  const Adjacency places = places_of(smaller, mesh.positions.size());
  double total_length = 0.0;
  std::vector<std::uint64_t> edges;  // of one vertex
  for (std::size_t v = 0; v < places.size(); ++v) {
    edges.clear();
    for (const std::uint32_t place : places[v]) edges.push_back(larger[place]);
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      const std::uint64_t other = edges[begin] / 2;
      while (end < edges.size() && edges[end] / 2 == other) ++end;
      const std::size_t faces = end - begin;
      ++report.edges;
      total_length += glm::length(mesh.positions[other] - mesh.positions[v]);
      if (mesh.positions[other] == mesh.positions[v]) ++report.zero_length_edges;
      if (faces == 1) ++report.boundary_edges;
      if (faces > 2) ++report.non_manifold_edges;
      if (faces == 2 && edges[begin] == edges[begin + 1]) ++report.flipped_edges;
    }
  }
  if (report.edges > 0) report.mean_edge_length = total_length / static_cast<double>(report.edges);
}

bool is_degenerate(const PolygonMesh& mesh, std::span<const std::uint32_t> face,
                   std::span<const std::uint32_t> sorted) {
  if (face.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return true;
  Vec<3> twice_area(0.0);
  double longest = 0.0;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec<3> a = mesh.positions[face[k]] - mesh.positions[face[0]];
    const Vec<3> b = mesh.positions[face[k + 1 < face.size() ? k + 1 : 0]] - mesh.positions[face[0]];
    twice_area += glm::cross(a, b);
    longest = std::max(longest, glm::dot(b - a, b - a));
  }
  constexpr double kNoArea = 1e-14;
  return !(glm::length(twice_area) > kNoArea * longest);
}

void count_faces(const PolygonMesh& mesh, MeshReport& report) {
  // The corners of each face in ascending order, and the first of them: vertex count where there is none.
  std::vector<std::uint32_t> sorted = mesh.corners;
  const auto corners = [&](std::size_t f) {
    return std::span(sorted).subspan(mesh.face_starts[f], mesh.face_starts[f + 1] - mesh.face_starts[f]);
  };
  std::vector<std::uint32_t> smallest(mesh.face_count(), static_cast<std::uint32_t>(mesh.positions.size()));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::sort(corners(f).begin(), corners(f).end());
    if (is_degenerate(mesh, mesh.face(f), corners(f))) ++report.degenerate_faces;
    if (!corners(f).empty()) smallest[f] = corners(f)[0];
  }
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(corners(a).begin(), corners(a).end(), corners(b).begin(),
                                        corners(b).end());
  };
  Adjacency faces = places_of(smallest, mesh.positions.size() + 1);
  for (std::size_t v = 0; v < faces.size(); ++v) {
    const auto begin = faces.items.begin() + faces.starts[v];
    const auto end = faces.items.begin() + faces.starts[v + 1];
    std::sort(begin, end, compare);
    for (auto face = begin; end - face > 1; ++face) {
      if (!compare(face[0], face[1])) ++report.duplicate_faces;
    }
  }
}

// Counts the sets of vertices that faces connect, by merging them: each vertex points towards the smallest
// vertex of its set.
void count_components(const PolygonMesh& mesh, MeshReport& report) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find_root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<bool> used(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t corner : mesh.face(f)) {
      used[corner] = true;
      const std::uint32_t a = find_root(mesh.face(f)[0]);
      const std::uint32_t b = find_root(corner);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    if (!used[v]) {
      ++report.isolated_vertices;
    } else if (parent[v] == v) {
      ++report.components;
    }
  }
}

}  // namespace

bool MeshReport::is_closed() const {
  return faces > 0 && boundary_edges == 0 && non_manifold_edges == 0 && flipped_edges == 0;
}

MeshReport inspect_mesh(const PolygonMesh& mesh) {
  MeshReport report;
  report.vertices = mesh.positions.size();
  report.faces = mesh.face_count();
  report.bounds = bounds_of<3>(mesh.positions);
  count_edges(mesh, report);
  count_faces(mesh, report);
  count_components(mesh, report);
  return report;
}

std::vector<std::string> mesh_warnings(const MeshReport& report) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view one, std::string_view many,
                        std::string_view what) {
    if (count > 0) warnings.push_back(fmt::format("{} {} {}", count, count == 1 ? one : many, what));
  };
  warn(report.non_manifold_edges, "edge is", "edges are", "between more than two faces");
  warn(report.flipped_edges, "edge is", "edges are",
       "between faces that disagree on the outside: curvature means nothing there");
  warn(report.zero_length_edges, "edge has", "edges have", "no length");
  warn(report.degenerate_faces, "face is", "faces are", "degenerate");
  warn(report.duplicate_faces, "face repeats", "faces repeat", "an earlier one");
  return warnings;
}

}  // namespace solidnoise
