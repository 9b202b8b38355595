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
};

template <typename Value>
void average_round(const SurfaceMesh& surface, const Carry& carry, std::vector<Value>& values,
                   const std::vector<double>& weights) {
  const std::vector<Value> old = values;
  const Adjacency& neighbours = surface.neighbours();
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
  HeatStep(const SurfaceMesh& surface, const Carry& carry, const std::vector<float>& edge_weights,
           double time)
      : neighbours_(surface.neighbours()),
        carry_(carry),
        edge_weights_(edge_weights),
        time_(time),
        masses_(surface.areas()),
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
void diffuse_values(const SurfaceMesh& surface, const Carry& carry, const std::vector<float>& edge_weights,
                    std::vector<Value>& values, double radius) {
  // In the plane the mean square of the way is 4 t; in one implicit step of time t as well.
  constexpr int kSteps = 2;
  const HeatStep<Value> step(surface, carry, edge_weights, 0.25 * radius * radius / kSteps);
  for (int i = 0; i < kSteps; ++i) step.run(values);
}

// The cotangent of the angle at c, up to the largest that makes sense for a sliver.
double cotangent(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  constexpr double kLargest = 100.0;
  const double cosine = glm::dot(a - c, b - c);
  const double sine = glm::length(glm::cross(a - c, b - c));
  return sine > 0.0 ? std::clamp(cosine / sine, -kLargest, kLargest) : std::copysign(kLargest, cosine);
}

}  // namespace

SurfaceSmoothing::SurfaceSmoothing(const SurfaceMesh& surface, const TangentFrames& frames)
    : surface_(surface), turns_(surface.neighbours().items.size()) {
  const Adjacency& neighbours = surface.neighbours();
  tbb::parallel_for(std::size_t{0}, surface.point_count(), [&](std::size_t p) {
    const TangentFrame frame = frames[p];
    for (std::size_t k = neighbours.starts[p]; k < neighbours.starts[p + 1]; ++k) {
      turns_[k] = std::complex<float>(line_at(transport(frames[neighbours.items[k]], frame)));
    }
  });
}

void SurfaceSmoothing::average(std::vector<ShapeOperator>& shapes, const std::vector<double>& weights) const {
  average_round(surface_, Carry{turns_}, shapes, weights);
}

void SurfaceSmoothing::average(std::vector<Line>& lines, const std::vector<double>& weights) const {
  average_round(surface_, Carry{turns_}, lines, weights);
}

void SurfaceSmoothing::diffuse(std::vector<ShapeOperator>& shapes, double radius) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius > 0.0) diffuse_values(surface_, Carry{turns_}, edge_weights(), shapes, radius);
}

void SurfaceSmoothing::diffuse(std::vector<Line>& lines, double radius) {
  require_at_least("the smoothing radius", radius, 0.0, "world units");
  if (radius > 0.0) diffuse_values(surface_, Carry{turns_}, edge_weights(), lines, radius);
}

const std::vector<float>& SurfaceSmoothing::edge_weights() {
  const Adjacency& neighbours = surface_.neighbours();
  if (edge_weights_.size() == neighbours.items.size()) return edge_weights_;
  edge_weights_.assign(neighbours.items.size(), 0.0f);
  const auto& positions = surface_.positions();
  tbb::parallel_for(std::size_t{0}, surface_.point_count(), [&](std::size_t p) {
    const auto around = neighbours[p];
    float* const weights = edge_weights_.data() + neighbours.starts[p];
    for (const std::uint32_t t : surface_.triangles_at(p)) {
      for (int corner = 0; corner < 3; ++corner) {
        const Triangle& triangle = surface_.triangles()[t];
        const std::uint32_t q = triangle[static_cast<std::size_t>(corner)];
        if (q == p) continue;
        const std::uint32_t r = triangle[0] + triangle[1] + triangle[2] - q - static_cast<std::uint32_t>(p);
        const auto entry = std::lower_bound(around.begin(), around.end(), q) - around.begin();
        weights[entry] += static_cast<float>(0.5 * cotangent(positions[p], positions[q], positions[r]));
      }
    }
    for (std::size_t k = 0; k < around.size(); ++k) weights[k] = std::max(weights[k], 0.0f);
  });
  return edge_weights_;
}

}  // namespace solidnoise
