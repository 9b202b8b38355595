#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// The half-edges of a mesh's faces, as OpenMesh's own format has them. Half-edges 2 e and 2 e + 1 are the two
// directions of edge e; those of one face make a loop, in the face's order, and so do those of no face,
// around each hole. Any faces with vertices will do: an edge joins two faces that go along it in opposite
// directions, in the order of the faces; where more meet, or where two agree in direction, there are several
// edges between the same two vertices, open on one side.
struct HalfEdges {
  struct HalfEdge {
    std::int32_t next = -1;
    std::int32_t vertex = -1;  // that it points to
    std::int32_t face = -1;    // -1: of none
  };

  std::vector<HalfEdge> halfedges;
  std::vector<std::int32_t> of_face;  // one of each face, that points to its first corner
  std::vector<std::int32_t>
      of_vertex;  // one that leaves it, of no face if there is such; -1 if there is none

  // Throws std::invalid_argument: a face without vertices, more half-edges than an int32 can number.
  explicit HalfEdges(const PolygonMesh& mesh);

  std::size_t edge_count() const { return halfedges.size() / 2; }
};

}  // namespace solidnoise
