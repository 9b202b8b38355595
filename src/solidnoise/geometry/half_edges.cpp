#include "solidnoise/geometry/half_edges.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace solidnoise {
namespace {

// The side of a face from one corner to the next.
struct Side {
  std::uint64_t vertices;  // of the edge: the smaller one in the upper half
  bool upward;             // from the smaller to the larger
  std::uint32_t corner;    // that it points to, in PolygonMesh::corners
};

std::vector<Side> sorted_sides(const PolygonMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.empty())
      throw std::invalid_argument(fmt::format("face {} has no vertices; OM holds none such", f));
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint64_t from = face[k == 0 ? face.size() - 1 : k - 1];
      const std::uint64_t to = face[k];
      sides.push_back({std::min(from, to) << 32 | std::max(from, to), from < to,
                       static_cast<std::uint32_t>(mesh.face_starts[f] + k)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.vertices, a.upward, a.corner) < std::tie(b.vertices, b.upward, b.corner);
  });
  return sides;
}

}  // namespace

HalfEdges::HalfEdges(const PolygonMesh& mesh) {
  if (mesh.corners.size() > std::numeric_limits<std::int32_t>::max() / 2) {
    throw std::invalid_argument(fmt::format("faces have {} corners; OM holds 2^30", mesh.corners.size()));
  }
  if (mesh.positions.size() > std::numeric_limits<std::int32_t>::max()) {
    throw std::invalid_argument(fmt::format("there are {} vertices; OM holds 2^31", mesh.positions.size()));
  }
  // An edge for each two sides that go opposite ways, and for each that is left over.
  std::vector<std::int32_t> at_corner(mesh.corners.size());  // the half-edge that points to it
  const auto add = [&](const Side& side) {
    const std::uint32_t vertex = mesh.corners[side.corner];
    at_corner[side.corner] = static_cast<std::int32_t>(halfedges.size());
    halfedges.push_back({-1, static_cast<std::int32_t>(vertex), 0});
  };
  const auto add_open = [&](const Side& side) {
    add(side);
    const std::uint64_t other =
        (side.vertices >> 32) ^ (side.vertices & 0xffffffffu) ^ mesh.corners[side.corner];
    halfedges.push_back({-1, static_cast<std::int32_t>(other), -1});
  };
  const std::vector<Side> sides = sorted_sides(mesh);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& side) { return side.vertices != first->vertices; });
    auto down = first;
    auto up = std::find_if(first, last, [](const Side& side) { return side.upward; });
    const auto middle = up;
    for (; down != middle && up != last; ++down, ++up) {
      add(*down);
      add(*up);
    }
    for (; down != middle; ++down) add_open(*down);
    for (; up != last; ++up) add_open(*up);
    first = last;
  }

  // Loops of faces, and the half-edge before each.
  std::vector<std::int32_t> previous(halfedges.size(), -1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    of_face.push_back(at_corner[mesh.face_starts[f]]);
    for (std::uint32_t k = mesh.face_starts[f]; k < mesh.face_starts[f + 1]; ++k) {
      const bool is_last = k + 1 == mesh.face_starts[f + 1];
      const std::int32_t next = at_corner[is_last ? mesh.face_starts[f] : k + 1];
      HalfEdge& halfedge = halfedges[static_cast<std::size_t>(at_corner[k])];
      halfedge.next = next;
      halfedge.face = static_cast<std::int32_t>(f);
      previous[static_cast<std::size_t>(next)] = at_corner[k];
    }
  }
  // Loops of holes: around the vertex that a half-edge points to, from face to face, until one of no face.
  of_vertex.assign(mesh.positions.size(), -1);
  for (std::size_t h = 0; h < halfedges.size(); ++h) {
    const auto from = static_cast<std::size_t>(halfedges[h ^ 1].vertex);
    if (halfedges[h].face >= 0) {
      if (of_vertex[from] < 0) of_vertex[from] = static_cast<std::int32_t>(h);
      continue;
    }
    of_vertex[from] = static_cast<std::int32_t>(h);
    std::size_t around = h ^ 1;
    while (halfedges[around].face >= 0) around = static_cast<std::size_t>(previous[around]) ^ 1;
    halfedges[h].next = static_cast<std::int32_t>(around);
  }
}

}  // namespace solidnoise
