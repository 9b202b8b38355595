#include "solidnoise/mesh/surface_smoothing.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

using Line = std::complex<double>;

double product(const Line& a, const Line& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
double product(const Vec<3>& a, const Vec<3>& b) {
  return glm::dot(a, b);
}
double product(const ShapeOperator& a, const ShapeOperator& b) {
  return a.mean * b.mean + product(a.line, b.line);
}

// The sum of term(i), in an order that depends on the count only.
template <typename Term>
double ordered_sum(std::size_t count, const Term& term) {
  constexpr std::size_t kGrain = 4096;
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, kGrain), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) sum += term(i);
        return sum;
      },
      std::plus<>());
}

// A neighbour's value as it is at the point.
struct Carry {
  const std::vector<std::complex<float>>& turns;
  Line operator()(const Line& line, std::size_t entry) const {
    const double c = turns[entry].real();
    const double s = turns[entry].imag();
    return {c * line.real() - s * line.imag(), s * line.real() + c * line.imag()};
  }
  ShapeOperator operator()(const ShapeOperator& shape, std::size_t entry) const {
    return {shape.mean, (*this)(shape.line, entry)};
  }
  Vec<3> operator()(const Vec<3>& vector, std::size_t) const { return vector; }
};

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

// The matrix M + t L: M has the areas on its diagonal, and (L x)_p is the sum of w_pq (x_p - x_q) over the
// neighbours q.
template <typename Value>
class HeatStep {
 public:
  HeatStep(const SmoothingLevel& level, double time)
      : neighbours_(level.neighbours),
        carry_{level.turns},
        edge_weights_(level.weights),
        time_(time),
        masses_(level.areas),
        diagonal_(masses_.size()) {
    tbb::parallel_for(std::size_t{0}, diagonal_.size(), [&](std::size_t p) {
      double flow = 0.0;
      for (std::size_t k = neighbours_.starts[p]; k < neighbours_.starts[p + 1]; ++k) {
        flow += time_ * edge_weights_[k];
      }
      if (!(masses_[p] + flow > 0.0)) masses_[p] = 1.0;  // an isolated point's equation is x = x
      diagonal_[p] = masses_[p] + flow;
    });
  }

  // Replaces x by the solution of (M + t L) y = M x.
  void run(std::vector<Value>& x) const {
    const std::size_t count = x.size();
    std::vector<Value> residual(count);
    std::vector<Value> step(count);
    std::vector<Value> image(count);
    // With x itself as the first guess, the residual is -t L x.
    multiply(x, image);
    const auto each = [count](const auto& body) { tbb::parallel_for(std::size_t{0}, count, body); };
    each([&](std::size_t i) {
      residual[i] = masses_[i] * x[i] - image[i];
      step[i] = (1.0 / diagonal_[i]) * residual[i];
    });
    const auto preconditioned_norm = [&] {
      return ordered_sum(count,
                         [&](std::size_t i) { return product(residual[i], residual[i]) / diagonal_[i]; });
    };
    const double wanted = kResidual * kResidual * ordered_sum(count, [&](std::size_t i) {
                            return product(masses_[i] * x[i], masses_[i] * x[i]) / diagonal_[i];
                          });
    double norm = preconditioned_norm();
    for (int iteration = 0; iteration < kMostIterations && norm > wanted; ++iteration) {
      multiply(step, image);
      const double length =
          norm / ordered_sum(count, [&](std::size_t i) { return product(step[i], image[i]); });
      each([&](std::size_t i) {
        x[i] += length * step[i];
        residual[i] -= length * image[i];
      });
      const double next = preconditioned_norm();
      const double ratio = next / norm;
      norm = next;
      each([&](std::size_t i) { step[i] = (1.0 / diagonal_[i]) * residual[i] + ratio * step[i]; });
    }
  }

 private:
  static constexpr double kResidual = 1e-4;
  static constexpr int kMostIterations = 2000;

  void multiply(const std::vector<Value>& x, std::vector<Value>& image) const {
    tbb::parallel_for(std::size_t{0}, x.size(), [&](std::size_t p) {
      Value sum = diagonal_[p] * x[p];
      for (std::size_t k = neighbours_.starts[p]; k < neighbours_.starts[p + 1]; ++k) {
        sum -= time_ * edge_weights_[k] * carry_(x[neighbours_.items[k]], k);
      }
      image[p] = sum;
    });
  }

  const Adjacency& neighbours_;
  const Carry carry_;
  const std::vector<float>& edge_weights_;
  const double time_;
  std::vector<double> masses_;
  std::vector<double> diagonal_;
};

template <typename Value>
void diffuse_on(const SmoothingLevel& level, std::vector<Value>& values, double radius) {
  // In the plane the mean square of the way is 4 t; in one implicit step of time t as well.
  constexpr int kSteps = 2;
  const HeatStep<Value> step(level, 0.25 * radius * radius / kSteps);
  for (int i = 0; i < kSteps; ++i) step.run(values);
}

// The means of clusters.
template <typename Value>
std::vector<Value> gather(const SmoothingLevel& fine, const CoarserLevel& coarse,
                          const std::vector<Value>& values) {
  std::vector<std::complex<float>> back = coarse.turns;
  for (std::complex<float>& turn : back) turn = std::conj(turn);
  const Carry carry{back};
  std::vector<Value> sums(coarse.level.size());
  for (std::size_t p = 0; p < values.size(); ++p) {
    sums[coarse.cluster_of[p]] += fine.areas[p] * carry(values[p], p);
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (coarse.level.areas[c] > 0.0) sums[c] = (1.0 / coarse.level.areas[c]) * sums[c];
  }
  return sums;
}

}  // namespace

void SurfaceSmoothing::average(std::vector<ShapeOperator>& shapes, const std::vector<double>& weights) const {
  average_round(points_, shapes, weights);
}

void SurfaceSmoothing::average(std::vector<Line>& lines, const std::vector<double>& weights) const {
  average_round(points_, lines, weights);
}

template <typename Value>
void SurfaceSmoothing::spread(std::size_t level, std::vector<Value>& values, double radius) {
  constexpr double kMostEdges = 10.0;   // that values are spread over on one level
  constexpr double kPolish = 1.5;       // of a coarser level's edges: what hides its clusters
  constexpr std::size_t kFewest = 100;  // places that are worth a coarser level
  const auto level_at = [this](std::size_t i) -> const SmoothingLevel& {
    return i == 0 ? points_ : coarser_[i - 1].level;
  };
  const double mean_edge = level_at(level).mean_edge;  // 0 where no place has a neighbour
  if (mean_edge == 0.0 || radius <= kMostEdges * mean_edge || values.size() < kFewest) {
    return diffuse_on(level_at(level), values, radius);
  }
  if (coarser_.size() == level) coarser_.push_back(make_coarser(level_at(level)));
  const double polish = kPolish * coarser_[level].level.mean_edge;
  std::vector<Value> means = gather(level_at(level), coarser_[level], values);
  spread(level + 1, means, std::sqrt(std::max(radius * radius - polish * polish, 0.0)));
  const CoarserLevel& coarse = coarser_[level];
  const Carry carry{coarse.turns};
  for (std::size_t p = 0; p < values.size(); ++p) {
    // An isolated place has no area, and keeps what it has.
    if (coarse.level.areas[coarse.cluster_of[p]] > 0.0) values[p] = carry(means[coarse.cluster_of[p]], p);
  }
  diffuse_on(level_at(level), values, std::min(polish, radius));
}

void SurfaceSmoothing::diffuse(std::vector<ShapeOperator>& shapes, double radius) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius > 0.0) spread(0, shapes, radius);
}

void SurfaceSmoothing::diffuse(std::vector<Line>& lines, double radius) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius > 0.0) spread(0, lines, radius);
}

void SurfaceSmoothing::diffuse(std::vector<Vec<3>>& vectors, double radius) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius > 0.0) spread(0, vectors, radius);
}

}  // namespace solidnoise
