#include "solidnoise/mesh/curvature.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstdint>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/mesh/jet_fit.h"
#include "solidnoise/mesh/surface_smoothing.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {
namespace {

// Appends the neighbours as the frame sees them, with weights that fall with the distance.
void gather(const SurfaceMesh& surface, const TangentFrame& frame, std::uint32_t centre,
            const std::vector<std::uint32_t>& around, std::vector<Neighbour>& neighbours) {
  neighbours.clear();
  const Vec<3>& origin = surface.positions()[centre];
  double largest = 0.0;
  for (const std::uint32_t other : around) {
    const Vec<3> d = surface.positions()[other] - origin;
    largest = std::max(largest, glm::dot(d, d));
    neighbours.push_back(
        {{glm::dot(d, frame.first), glm::dot(d, frame.second), glm::dot(d, frame.normal)}, glm::dot(d, d)});
  }
  for (Neighbour& neighbour : neighbours) {
    neighbour.weight = std::exp(-2.0 * neighbour.weight / largest);
  }
}

// The shape operators of points, mean curvature and line apart.
struct Shapes {
  std::vector<double> means;
  std::vector<std::complex<double>> lines;
};

Shapes fit_shapes(const SurfaceMesh& surface, const TangentFrames& frames, Progress& progress) {
  constexpr std::size_t kNeighbours = 16;
  std::atomic<std::size_t> done = 0;
  Shapes shapes{std::vector<double>(surface.point_count()),
                std::vector<std::complex<double>>(surface.point_count())};
  tbb::enumerable_thread_specific<RingSearch> searches([&] { return RingSearch(surface.neighbours()); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.point_count(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      throw_if_cancelled(&progress);
                      RingSearch& search = searches.local();
                      std::vector<Neighbour> neighbours;
                      for (std::size_t p = range.begin(); p < range.end(); ++p) {
                        const auto centre = static_cast<std::uint32_t>(p);
                        gather(surface, frames[p], centre, search.around(centre, kNeighbours), neighbours);
                        const ShapeOperator shape = fit_shape(neighbours);
                        shapes.means[p] = shape.mean;
                        shapes.lines[p] = shape.line;
                      }
                      progress.advance(done += range.end() - range.begin(), surface.point_count());
                    });
  return shapes;
}

// Measures and smooths, the lines only where they are wanted. Fitting takes as long as forty rounds, a radius
// as thirty, of lines as seventy more.
Shapes measure_shapes(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                      const CurvatureOptions& options, bool lines, Progress* progress) {
  options.validate();
  constexpr double kFitting = 40.0;
  const double diffusion = lines ? 100.0 : 30.0;
  const double all = kFitting + options.rounds + (options.radius > 0.0 ? diffusion : 0.0);
  PartialProgress fitting(progress, 0.0, kFitting / all);
  PartialProgress rounds(progress, kFitting / all, (kFitting + options.rounds) / all);
  Shapes shapes = fit_shapes(surface, TangentFrames(surface.normals()), fitting);
  for (int round = 0; round < options.rounds; ++round) {
    throw_if_cancelled(progress);
    smoothing.average(shapes.means, surface.areas());
    if (lines) smoothing.average(shapes.lines, surface.areas());
    rounds.advance(static_cast<std::uint64_t>(round) + 1, static_cast<std::uint64_t>(options.rounds));
  }
  throw_if_cancelled(progress);
  smoothing.diffuse(shapes.means, options.radius, progress);
  if (lines) smoothing.diffuse(shapes.lines, options.radius, progress);
  return shapes;
}

}  // namespace

void CurvatureOptions::validate() const {
  require_in_range("the rounds of smoothing", rounds, 0, 10000);
  require_at_least("the smoothing radius", radius, 0.0, "world units");
}

Curvature measure_curvature(const SurfaceMesh& surface, const CurvatureOptions& options, Progress* progress) {
  SurfaceSmoothing smoothing(surface);
  return measure_curvature(surface, smoothing, options, progress);
}

Curvature measure_curvature(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                            const CurvatureOptions& options, Progress* progress) {
  const Shapes shapes = measure_shapes(surface, smoothing, options, true, progress);
  const TangentFrames frames(surface.normals());
  const std::size_t count = surface.vertex_count();
  Curvature curvature{std::vector<double>(count), std::vector<double>(count), std::vector<Vec<3>>(count),
                      std::vector<Vec<3>>(count)};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const std::uint32_t p = surface.point_of(v);
    const double half_difference = std::abs(shapes.lines[p]);
    curvature.k1[v] = shapes.means[p] + half_difference;
    curvature.k2[v] = shapes.means[p] - half_difference;
    const TangentFrame frame = frames[p];
    const std::complex<double> direction = direction_of_line(shapes.lines[p]);
    curvature.k1_direction[v] = frame.in_space(direction);
    curvature.k2_direction[v] = frame.in_space({-direction.imag(), direction.real()});
  });
  return curvature;
}

std::vector<double> measure_mean_curvature(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                                           const CurvatureOptions& options, Progress* progress) {
  return surface.to_vertices(measure_shapes(surface, smoothing, options, false, progress).means);
}

}  // namespace solidnoise
