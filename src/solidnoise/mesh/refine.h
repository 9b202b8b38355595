#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

struct RefineOptions {
  enum class Placement {
    on_edges,  // in the middle of the edge: the shape stays as it is
    smooth,    // on a curve through the edge's ends, perpendicular to the surface's normals there
  };
  // Ours takes any mesh. The others are OpenMesh's and take triangles that make a manifold, in which vertices
  // at equal positions stay apart.
  enum class Method {
    own,           // all edges that are too long at once, in rounds
    longest_edge,  // the longest edge of all first, one by one: the fewest vertices
    sqrt3,         // Kobbelt 2000: a round takes three times the triangles; smooths, moving all vertices
    loop,          // Loop 1987: a round takes four times the triangles; smooths, moving all vertices
  };

  Method method = Method::own;
  Placement placement = Placement::on_edges;  // of the own method
  std::size_t most_vertices = 50'000'000;     // more is refused, >= 1
  std::size_t most_faces = 100'000'000;       // the same
};

// Those that a new vertex is between: the ends of the edge that it halves; by the square root of three, the
// corners of a triangle, or an edge's ends with the nearer one twice.
class Parents {
 public:
  Parents(std::uint32_t a, std::uint32_t b) : vertices_{a, b, a}, count_(2) {}
  Parents(std::uint32_t a, std::uint32_t b, std::uint32_t c) : vertices_{a, b, c}, count_(3) {}

  std::span<const std::uint32_t> vertices() const { return std::span(vertices_).first(count_); }
  // The mean of what they have.
  template <typename Number>
  Number mean(const std::vector<Number>& numbers) const {
    Number sum = numbers[vertices_[0]];
    for (const std::uint32_t vertex : vertices().subspan(1)) sum += numbers[vertex];
    return sum / static_cast<Number>(count_);
  }

 private:
  std::array<std::uint32_t, 3> vertices_;
  std::uint32_t count_;
};

// A mesh with more vertices, and where these come from.
struct RefinedMesh {
  PolygonMesh mesh;
  // Of each new vertex, in order; they may be new vertices themselves, of smaller indices.
  std::vector<Parents> parents;

  // Numbers that the vertices had before, with the means of the parents' for the new ones. What is measured
  // on the mesh as it was, such as curvature, is better carried over than measured again: edges stay where
  // they were, and cutting them up makes them sharper.
  std::vector<float> carry(std::vector<float> numbers) const;
  // Carries lines, of either sign: new ones are between those of the parents (LineMean).
  std::vector<Vec<3>> carry_lines(std::vector<Vec<3>> directions) const;
  // Carries the mesh's properties: nx ny nz at length 1, integers rounded.
  void carry_properties();
};

// Splits edges until none is longer than the target, world units. `target` has one length per vertex, and the
// smaller one of an edge's ends counts, or one for all.
//
// In each round all edges that are too long are halved, and each triangle is cut into two, three or four by
// the new vertices: faces that share an edge share what it is cut into, however many they are. The mesh's
// vertices keep their positions and their indices, and new ones come after; a property's value is the mean of
// those at the edge's ends (nx ny nz at length 1, integers rounded), and so is the target. New vertices on
// seams, where vertices of one point (see SurfaceMesh) are split, are at equal positions. Polygons with an
// edge or diagonal that is too long become triangles, in the place that they had; all others stay.
//
// `smooth` places the new vertex in the middle of the edge's curve of Vlachos et al. 2001 ("Curved PN
// triangles"), with the surface's normals n at its ends:
//   (a + b) / 2 - (((b - a).n_a) n_a + ((a - b).n_b) n_b) / 8.
//
// OpenMesh's methods have one density for the whole mesh: `longest_edge` splits edges that are longer than
// the smallest target, the others make as many rounds as the edge that is longest over its target needs if
// each makes edges 2 or sqrt(3) times shorter. Vertices keep their indices, and properties are carried, as
// above.
//
// Throws std::invalid_argument: a target that is not positive, naming the vertex; a number of targets that is
// neither 1 nor that of the vertices; more faces than allowed, which are counted before any work; more
// vertices than allowed; what SurfaceMesh throws; a mesh that is no manifold of triangles, naming the face,
// where OpenMesh's methods need one. Cancelled, between the rounds of our own method.
RefinedMesh refine(const PolygonMesh& mesh, std::span<const double> target, const RefineOptions& options = {},
                   Progress* progress = nullptr);

// About how many vertices refine() makes, without making any: exact for our own method on closed surfaces
// whose new vertices lie on the edges. Counting ends at `most`, and more is said as infinity. Throws what
// refine() does of its arguments.
double refined_vertices(const PolygonMesh& mesh, std::span<const double> target, const RefineOptions& options,
                        double most);

// Halves every edge, `rounds` times (0 to 16): each triangle becomes 4^rounds, by `sqrt3` 3^rounds; by
// `longest_edge` edges are split that are longer than the longest over 2^rounds. The rest is as for refine().
RefinedMesh subdivide(const PolygonMesh& mesh, int rounds, const RefineOptions& options = {},
                      Progress* progress = nullptr);

// refine() and subdivide() by OpenMesh's subdividers, of a method that is not our own. `targets` has a length
// for every vertex. OpenMesh's adaptive subdividers are left aside: they know no lengths of edges, only faces
// to split.
RefinedMesh refine_by_openmesh(const PolygonMesh& mesh, const std::vector<double>& targets,
                               const RefineOptions& options);
RefinedMesh subdivide_by_openmesh(const PolygonMesh& mesh, int rounds, const RefineOptions& options);

// How many rounds of `loop` or `sqrt3` these lengths take.
int openmesh_rounds(const PolygonMesh& mesh, const std::vector<double>& targets,
                    RefineOptions::Method method);

// Throws std::invalid_argument if a refined mesh may not have as many vertices.
void require_vertices(std::size_t count, const RefineOptions& options);

}  // namespace solidnoise
