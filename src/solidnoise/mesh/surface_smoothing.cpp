#include "solidnoise/mesh/surface_smoothing.h"

#include <span>

#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/mesh/heat_solver.h"

namespace solidnoise {
namespace {

using Line = std::complex<double>;

template <typename Value>
void average_round(const SmoothingLevel& points, std::vector<Value>& values,
                   const std::vector<double>& weights) {
  const std::vector<Value> old = values;
  const Carry carry{points.turns};
  const Adjacency& neighbours = points.neighbours;
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t p) {
    Value sum = weights[p] * old[p];
    double total = weights[p];
    for (std::size_t k = neighbours.starts[p]; k < neighbours.starts[p + 1]; ++k) {
      const std::uint32_t other = neighbours.items[k];
      sum += weights[other] * carry(old[other], k);
      total += weights[other];
    }
    if (total > 0.0) values[p] = (1.0 / total) * sum;
  });
}

}  // namespace

const SmoothingLevel& SurfaceSmoothing::points() {
  if (!points_) points_ = level_of_points(surface_, normals_);
  return *points_;
}

void SurfaceSmoothing::average(std::vector<double>& numbers, const std::vector<double>& weights) {
  average_round(points(), numbers, weights);
}

void SurfaceSmoothing::average(std::vector<Line>& lines, const std::vector<double>& weights) {
  average_round(points(), lines, weights);
}

template <typename Value>
void SurfaceSmoothing::spread(std::vector<Value>& values, double radius, Progress* progress) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius == 0.0) return;
  // Over so few edges a level needs no coarser one, and of those that are hardly smaller there is no end.
  constexpr double kFewEdges = 2.0;
  constexpr double kWorthwhile = 0.8;
  std::size_t depth = 0;
  const auto coarsest = [&]() -> const SmoothingLevel& {
    return depth > 0 ? coarser_[depth - 1].level : points();
  };
  while (coarsest().mean_edge > 0.0 && radius > kFewEdges * coarsest().mean_edge) {
    throw_if_cancelled(progress);
    if (coarser_.size() == depth) coarser_.push_back(make_coarser(coarsest()));
    const double size = static_cast<double>(coarsest().size());
    if (!(static_cast<double>(coarser_[depth].level.size()) < kWorthwhile * size)) break;
    ++depth;
  }
  // In the plane the mean square of the way is 4 t; in one implicit step of time t as well.
  constexpr int kSteps = 2;
  HeatSolver<Value> solver(points(), std::span(coarser_).first(depth), 0.25 * radius * radius / kSteps);
  for (int i = 0; i < kSteps; ++i) solver.step(values, progress);
}

void SurfaceSmoothing::diffuse(std::vector<double>& numbers, double radius, Progress* progress) {
  spread(numbers, radius, progress);
}

void SurfaceSmoothing::diffuse(std::vector<Line>& lines, double radius, Progress* progress) {
  spread(lines, radius, progress);
}

void SurfaceSmoothing::diffuse(std::vector<Vec<3>>& vectors, double radius, Progress* progress) {
  spread(vectors, radius, progress);
}

}  // namespace solidnoise
