#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {

// Smooths numbers and lines over a surface. Lines (see tangent_frames.h) are carried from one tangent plane
// to the next before they are added.
class SurfaceSmoothing {
 public:
  // Keeps a reference to the surface.
  SurfaceSmoothing(const SurfaceMesh& surface, const TangentFrames& frames);

  // One round: at each point the mean of its value and its neighbours', weighted by `weights` (>= 0, one per
  // point). Where all of these are 0, the value stays.
  void average(std::vector<ShapeOperator>& shapes, const std::vector<double>& weights) const;
  void average(std::vector<std::complex<double>>& lines, const std::vector<double>& weights) const;

  // Spreads the values as heat does until the root mean square of the way is `radius` (world units, along the
  // surface): on a plane, the convolution with a bell of that radius, however fine the mesh. Two implicit
  // steps of the heat equation, with the cotangent weights of Pinkall and Polthier 1993; the linear systems
  // are solved by conjugate gradients to a relative residual of 1e-4. Negative weights, of obtuse triangles,
  // are taken as 0: no value leaves the range of the others, but such triangles conduct too well. Throws
  // std::invalid_argument if the radius is not at least 0.
  void diffuse(std::vector<ShapeOperator>& shapes, double radius);
  void diffuse(std::vector<std::complex<double>>& lines, double radius);

 private:
  const std::vector<float>& edge_weights();

  const SurfaceMesh& surface_;
  // For each neighbour, in the order of the surface's adjacency:
  std::vector<std::complex<float>> turns_;  // what its line is to be multiplied with
  std::vector<float> edge_weights_;         // made when first needed
};

}  // namespace solidnoise
