#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// What a mesh is like, and what is wrong with it. Edges are those of the polygons, between two different
// vertices, each counted once.
struct MeshReport {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  std::size_t components = 0;          // of faces that share vertices
  Box<3> bounds;                       // of all vertices, world units
  double mean_edge_length = 0.0;       // world units
  std::size_t boundary_edges = 0;      // in one face
  std::size_t non_manifold_edges = 0;  // in more than two faces
  std::size_t flipped_edges = 0;       // in two faces that go around them the same way: one is inside out
  std::size_t zero_length_edges = 0;   // between vertices at one position
  std::size_t degenerate_faces = 0;    // less than three corners, the same vertex twice, or no area
  std::size_t duplicate_faces = 0;     // of the same vertices as an earlier face
  std::size_t isolated_vertices = 0;   // in no face

  // Whether every edge is between two faces that agree on the outside.
  bool is_closed() const;
};

// A face has no area if it is below 1e-14 of its longest edge squared: rounding makes more of a line.
// Takes 0.3 s for two million triangles.
MeshReport inspect_mesh(const PolygonMesh& mesh);

// What deserves a warning, in plain words, one line each: non-manifold and zero-length edges, flipped,
// degenerate and duplicate faces. Boundaries and isolated vertices are no fault.
std::vector<std::string> mesh_warnings(const MeshReport& report);

}  // namespace solidnoise
