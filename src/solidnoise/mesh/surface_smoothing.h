#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/mesh/smoothing_level.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {

// Smooths numbers, lines and vectors over a surface, one value per point. Lines (see tangent_frames.h) are
// carried from one tangent plane to the next before they are added. What it needs to know of the surface it
// finds out when it is first used.
class SurfaceSmoothing {
 public:
  // Keeps a reference to the surface.
  explicit SurfaceSmoothing(const SurfaceMesh& surface) : SurfaceSmoothing(surface, surface.normals()) {}
  // Lines lie in the planes of these unit normals, one per point, and not in the surface's; keeps them, too.
  SurfaceSmoothing(const SurfaceMesh& surface, std::span<const Vec<3>> normals)
      : surface_(surface), normals_(normals) {}

  // One round: at each point the mean of its value and its neighbours', weighted by `weights` (>= 0, one per
  // point). Where all of these are 0, the value stays.
  void average(std::vector<double>& numbers, const std::vector<double>& weights);
  void average(std::vector<std::complex<double>>& lines, const std::vector<double>& weights);

  // Spreads the values as heat does until the root mean square of the way is `radius` (world units, along the
  // surface): on a plane, the convolution with a bell of that radius, however fine the mesh. Two implicit
  // steps of the heat equation, each to 1e-4 of the values' root mean square, in a time that does not grow
  // with the radius (HeatSolver). No value leaves the range of the others by more than that. Throws
  // std::invalid_argument if the radius is not at least 0; Cancelled.
  void diffuse(std::vector<double>& numbers, double radius, Progress* progress = nullptr);
  void diffuse(std::vector<std::complex<double>>& lines, double radius, Progress* progress = nullptr);
  // Of space: they are not carried.
  void diffuse(std::vector<Vec<3>>& vectors, double radius, Progress* progress = nullptr);

 private:
  template <typename Value>
  void spread(std::vector<Value>& values, double radius, Progress* progress);

  const SmoothingLevel& points();

  const SurfaceMesh& surface_;
  std::span<const Vec<3>> normals_;
  std::optional<SmoothingLevel> points_;
  std::vector<CoarserLevel> coarser_;
};

}  // namespace solidnoise
