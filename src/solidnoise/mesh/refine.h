#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

struct RefineOptions {
  enum class Placement {
    on_edges,  // in the middle of the edge: the shape stays as it is
    smooth,    // on a curve through the edge's ends, perpendicular to the surface's normals there
  };

  Placement placement = Placement::on_edges;
  std::size_t most_vertices = 50'000'000;  // more is refused, >= 1
};

// A mesh with more vertices, and where these come from.
struct RefinedMesh {
  PolygonMesh mesh;
  // For each new vertex, in order, the ends of the edge that it halves; these may be new vertices themselves,
  // of smaller indices.
  std::vector<std::array<std::uint32_t, 2>> edges;

  // Numbers that the vertices had before, with the means of the ends' for the new ones. What is measured on
  // the mesh as it was, such as curvature, is better carried over than measured again: edges stay where they
  // were, and cutting them up makes them sharper.
  std::vector<float> carry(std::vector<float> numbers) const;
  std::vector<double> carry(std::vector<double> numbers) const;
  // The same for lines, of either sign and length 1: a direction between those of the ends.
  std::vector<Vec<3>> carry_lines(std::vector<Vec<3>> directions) const;
};

// Splits edges until none is longer than the target, world units. `target` has one length per vertex, and the
// smaller one of an edge's ends counts, or one for all.
//
// In each round all edges that are too long are halved, and each triangle is cut into two, three or four by
// the new vertices: faces that share an edge share what it is cut into, however many they are. The mesh's
// vertices keep their positions and their indices, and new ones come after; a property's value is the mean of
// those at the edge's ends (nx ny nz at length 1, integers rounded), and so is the target. New vertices on
// seams, where vertices at equal positions are split, are at equal positions too. Polygons with an edge or
// diagonal that is too long become triangles, in the place that they had; all others stay.
//
// `smooth` places the new vertex in the middle of the edge's curve of Vlachos et al. 2001 ("Curved PN
// triangles"), with the surface's normals n at its ends:
//   (a + b) / 2 - (((b - a).n_a) n_a + ((a - b).n_b) n_b) / 8.
//
// Throws std::invalid_argument: a target that is not positive, naming the vertex; a number of targets that is
// neither 1 nor that of the vertices; more vertices than allowed; what SurfaceMesh throws.
RefinedMesh refine(const PolygonMesh& mesh, std::span<const double> target,
                   const RefineOptions& options = {});

// Halves every edge, `rounds` times (0 to 16): each triangle becomes 4^rounds. The rest is as for refine().
RefinedMesh subdivide(const PolygonMesh& mesh, int rounds, const RefineOptions& options = {});

}  // namespace solidnoise
