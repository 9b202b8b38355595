#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/adjacency.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// The surface that a polygon mesh stands for. Files split vertices where texture coordinates or normals jump;
// a surface has no such seams. So the mesh's vertices at equal positions are one *point* of the surface, and
// whatever depends on neighbours is computed at points: `point_of` leads from a vertex to its point. Points
// are numbered in the order of their first vertices; without split vertices, points are the vertices.
//
// The sides of a seam may be apart by rounding: a sphere's last meridian is where the sine of a whole turn
// is, which is not quite 0. So points at boundaries are one too if they are no farther apart than 2^-22 of
// the mesh's longest side, and 2^-10 of the longest edge at either, below which it may be a detail; the first
// vertex's position is the point's. Inside their boundaries, sheets that lie on each other but for rounding
// stay two.
//
// Any mesh will do: edges may have any number of triangles, and their windings may disagree. Polygons are cut
// into triangles; triangles with two corners at one point are left out, and so are those of the same three
// points as an earlier one. A point without triangles is isolated.
//
// Immutable; may be shared between threads. Nothing depends on the number of threads.
class SurfaceMesh {
 public:
  // Throws std::invalid_argument naming the vertex or face: a position that is not finite, a face that names
  // a vertex which is not there.
  explicit SurfaceMesh(const PolygonMesh& mesh);

  std::size_t vertex_count() const { return point_of_.size(); }
  std::size_t point_count() const { return positions_.size(); }
  std::uint32_t point_of(std::size_t vertex) const { return point_of_[vertex]; }
  // The first vertex at a point.
  std::uint32_t vertex_at(std::size_t point) const { return first_vertex_[point]; }

  // Of points:
  const std::vector<Vec<3>>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  // The points that share an edge with this one, in ascending order.
  std::span<const std::uint32_t> neighbours(std::size_t point) const { return neighbours_[point]; }
  const Adjacency& neighbours() const { return neighbours_; }
  // The indices of the triangles around a point, in ascending order.
  std::span<const std::uint32_t> triangles_at(std::size_t point) const { return triangles_at_[point]; }
  // Whether an edge of only one triangle ends here.
  bool on_boundary(std::size_t point) const { return on_boundary_[point] != 0; }
  // Unit normals: those of the triangles around, each weighted by its area times its angle at the point.
  // Where they cancel, that of the largest triangle; +Y at isolated points.
  const std::vector<Vec<3>>& normals() const { return normals_; }
  // The point's share of the surface, world units squared: the mixed Voronoi areas of Meyer et al. 2003,
  // section 3.3. They add up to the area of all triangles; 0 at isolated points.
  const std::vector<double>& areas() const { return areas_; }

  // Over all edges, each counted once; world units, 0 if there are none.
  double mean_edge_length() const { return mean_edge_length_; }

  // What points have, given to the vertices.
  template <typename T>
  std::vector<T> to_vertices(const std::vector<T>& of_points) const {
    std::vector<T> of_vertices(vertex_count());
    for (std::size_t v = 0; v < of_vertices.size(); ++v) of_vertices[v] = of_points[point_of_[v]];
    return of_vertices;
  }

 private:
  // `first`: for each point itself, or an earlier one that it becomes one with.
  void join_points(const std::vector<std::uint32_t>& first);
  // How far the other side of a seam may be at most; 0 inside boundaries.
  std::vector<double> seam_gaps() const;
  void drop_duplicates();
  void connect();
  void measure_points();

  std::vector<std::uint32_t> point_of_;
  std::vector<std::uint32_t> first_vertex_;
  std::vector<Vec<3>> positions_;
  std::vector<Triangle> triangles_;
  Adjacency triangles_at_;
  Adjacency neighbours_;
  std::vector<char> on_boundary_;
  std::vector<Vec<3>> normals_;
  std::vector<double> areas_;
  double mean_edge_length_ = 0.0;
};

}  // namespace solidnoise
