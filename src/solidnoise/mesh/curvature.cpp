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

std::vector<ShapeOperator> fit_shapes(const SurfaceMesh& surface, const TangentFrames& frames,
                                      Progress& progress) {
  constexpr std::size_t kNeighbours = 16;
  std::atomic<std::size_t> done = 0;
  std::vector<ShapeOperator> shapes(surface.point_count());
  tbb::enumerable_thread_specific<RingSearch> searches([&] { return RingSearch(surface.neighbours()); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.point_count(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      throw_if_cancelled(&progress);
                      RingSearch& search = searches.local();
                      std::vector<Neighbour> neighbours;
                      for (std::size_t p = range.begin(); p < range.end(); ++p) {
                        const auto centre = static_cast<std::uint32_t>(p);
                        gather(surface, frames[p], centre, search.around(centre, kNeighbours), neighbours);
                        shapes[p] = fit_shape(neighbours);
                      }
                      progress.advance(done += range.end() - range.begin(), surface.point_count());
                    });
  return shapes;
}

}  // namespace

void CurvatureOptions::validate() const {
  require_in_range("the rounds of smoothing", rounds, 0, 10000);
  require_at_least("the smoothing radius", radius, 0.0, "world units");
}

Curvature measure_curvature(const SurfaceMesh& surface, const CurvatureOptions& options, Progress* progress) {
  options.validate();
  // Fitting takes as long as twenty rounds, a radius as ten.
  const double all = 20.0 + options.rounds + (options.radius > 0.0 ? 10.0 : 0.0);
  PartialProgress fitting(progress, 0.0, 20.0 / all);
  PartialProgress rounds(progress, 20.0 / all, (20.0 + options.rounds) / all);
  const TangentFrames frames(surface.normals());
  std::vector<ShapeOperator> shapes = fit_shapes(surface, frames, fitting);
  if (options.rounds > 0 || options.radius > 0.0) {
    SurfaceSmoothing smoothing(surface);
    for (int round = 0; round < options.rounds; ++round) {
      throw_if_cancelled(progress);
      smoothing.average(shapes, surface.areas());
      rounds.advance(static_cast<std::uint64_t>(round) + 1, static_cast<std::uint64_t>(options.rounds));
    }
    throw_if_cancelled(progress);
    smoothing.diffuse(shapes, options.radius, progress);
  }

  const std::size_t count = surface.vertex_count();
  Curvature curvature{std::vector<double>(count), std::vector<double>(count), std::vector<Vec<3>>(count),
                      std::vector<Vec<3>>(count)};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const TangentFrame frame = frames[surface.point_of(v)];
    const ShapeOperator& shape = shapes[surface.point_of(v)];
    const double half_difference = std::abs(shape.line);
    curvature.k1[v] = shape.mean + half_difference;
    curvature.k2[v] = shape.mean - half_difference;
    const std::complex<double> direction = direction_of_line(shape.line);
    curvature.k1_direction[v] = frame.in_space(direction);
    curvature.k2_direction[v] = frame.in_space({-direction.imag(), direction.real()});
  });
  return curvature;
}

}  // namespace solidnoise
