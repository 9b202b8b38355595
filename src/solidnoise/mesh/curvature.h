#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

class SurfaceSmoothing;

// Smoothing of measured curvature. What is averaged are shape operators, as tensors carried along the
// surface, not principal curvatures: opposite bends cancel.
struct CurvatureOptions {
  int rounds = 0;       // of averaging with the neighbours, weighted by area; 0 to 10000
  double radius = 0.0;  // of smoothing that does not depend on the mesh (SurfaceSmoothing::diffuse), applied
                        // after the rounds; world units, >= 0; 0 is none

  // Throws std::invalid_argument: field, value, what is allowed.
  void validate() const;
};

// The principal curvatures k1 >= k2 of a mesh's vertices, in 1/world unit, positive where the surface bends
// away from its normal (is convex, if normals are outward): a sphere of radius R has k1 = k2 = 1/R, a saddle
// k1 > 0 > k2. Turning the mesh inside out gives (-k2, -k1).
struct Curvature {
  std::vector<double> k1;
  std::vector<double> k2;
  // Unit tangents along which the surface bends by k1 and k2, perpendicular to each other and to the
  // surface's normal at the vertex. Either sign would do; where k1 = k2, any direction.
  std::vector<Vec<3>> k1_direction;
  std::vector<Vec<3>> k2_direction;

  std::size_t size() const { return k1.size(); }
  double mean(std::size_t vertex) const { return 0.5 * (k1[vertex] + k2[vertex]); }  // H
  double gaussian(std::size_t vertex) const { return k1[vertex] * k2[vertex]; }      // K, 1/world unit^2
};

// The curvature of the surface that the mesh samples, at each vertex (not point) of it. A cubic is fitted to
// each point and its neighbours within two edges, or more if these are less than 16 (fit_shape); boundaries
// have neighbours on one side only and errors three times as large. 0 at isolated points. Without smoothing,
// if vertices are on a smooth surface the error is O(h^2) for edges of length h, whatever the connectivity,
// but noise of sigma in the positions is one of about sigma / h^2. Takes 1 s for a million vertices (two
// cores), 10 rounds a quarter more, a radius of ten edges 2 s more, of a hundred 3 s. Throws Cancelled where
// `progress` asks for it.
Curvature measure_curvature(const SurfaceMesh& surface, const CurvatureOptions& options = {},
                            Progress* progress = nullptr);
// With the smoothing of this surface, which may have been used for others.
Curvature measure_curvature(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                            const CurvatureOptions& options, Progress* progress);

// The mean curvatures alone, which are those of measure_curvature() but for rounding: a radius takes a third
// of the time.
std::vector<double> measure_mean_curvature(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                                           const CurvatureOptions& options, Progress* progress);

}  // namespace solidnoise
