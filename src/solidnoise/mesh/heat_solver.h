#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "solidnoise/core/progress.h"
#include "solidnoise/mesh/smoothing_level.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {

inline double product(const std::complex<double>& a, const std::complex<double>& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
inline double product(const Vec<3>& a, const Vec<3>& b) {
  return glm::dot(a, b);
}
inline double product(const ShapeOperator& a, const ShapeOperator& b) {
  return a.mean * b.mean + product(a.line, b.line);
}

// A value of one place as it is at another.
struct Carry {
  const std::vector<std::complex<float>>& turns;

  std::complex<double> operator()(const std::complex<double>& line, std::size_t entry) const {
    return turned(line, turns[entry].real(), turns[entry].imag());
  }
  ShapeOperator operator()(const ShapeOperator& shape, std::size_t entry) const {
    return {shape.mean, (*this)(shape.line, entry)};
  }
  Vec<3> operator()(const Vec<3>& vector, std::size_t) const { return vector; }

  // The way back.
  std::complex<double> back(const std::complex<double>& line, std::size_t entry) const {
    return turned(line, turns[entry].real(), -turns[entry].imag());
  }
  ShapeOperator back(const ShapeOperator& shape, std::size_t entry) const {
    return {shape.mean, back(shape.line, entry)};
  }
  Vec<3> back(const Vec<3>& vector, std::size_t) const { return vector; }

 private:
  static std::complex<double> turned(const std::complex<double>& line, double c, double s) {
    return {c * line.real() - s * line.imag(), s * line.real() + c * line.imag()};
  }
};

// The matrix A = M + t L on a level: M has the areas on its diagonal, and (L x)_p is the sum of
// w_pq (x_p - x_q) over the neighbours q.
template <typename Value>
class HeatMatrix {
 public:
  HeatMatrix(const SmoothingLevel& level, double time)
      : level_(level), carry_{level.turns}, time_(time), masses_(level.areas), diagonal_(level.size()) {
    const Adjacency& neighbours = level.neighbours;
    tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t p) {
      double flow = 0.0;
      for (std::size_t k = neighbours.starts[p]; k < neighbours.starts[p + 1]; ++k) {
        flow += time_ * level.weights[k];
      }
      if (!(masses_[p] + flow > 0.0)) masses_[p] = 1.0;  // an isolated point's equation is x = x
      diagonal_[p] = masses_[p] + flow;
    });
  }

  std::size_t size() const { return diagonal_.size(); }
  double mass(std::size_t p) const { return masses_[p]; }

  Value row(const std::vector<Value>& x, std::size_t p) const {
    Value sum = diagonal_[p] * x[p];
    for (std::size_t k = level_.neighbours.starts[p]; k < level_.neighbours.starts[p + 1]; ++k) {
      sum -= time_ * level_.weights[k] * carry_(x[level_.neighbours.items[k]], k);
    }
    return sum;
  }

  // A round of Jacobi's method for A x = b, damped: with less than 1 every error shrinks, for the eigenvalues
  // of A over its diagonal lie between 0 and 2. `scratch` has the same size.
  void relax(const std::vector<Value>& b, std::vector<Value>& x, std::vector<Value>& scratch) const {
    tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t p) {
      scratch[p] = x[p] + (kDamping / diagonal_[p]) * (b[p] - row(x, p));
    });
    x.swap(scratch);
  }
  // The same from x = 0.
  void relax_zero(const std::vector<Value>& b, std::vector<Value>& x) const {
    tbb::parallel_for(std::size_t{0}, size(),
                      [&](std::size_t p) { x[p] = (kDamping / diagonal_[p]) * b[p]; });
  }

 private:
  static constexpr double kDamping = 0.7;

  const SmoothingLevel& level_;
  const Carry carry_;
  const double time_;
  std::vector<double> masses_;
  std::vector<double> diagonal_;
};

// Implicit steps of the heat equation: conjugate gradients with a V-cycle of multigrid over the coarser
// levels, which takes as many rounds for a long time as for a short one (Trottenberg et al. 2001, chapters 2
// and 7.8).
template <typename Value>
class HeatSolver {
 public:
  // `coarser` (any number of levels, each of the one before) and `points` must outlive this.
  HeatSolver(const SmoothingLevel& points, std::span<const CoarserLevel> coarser, double time)
      : coarser_(coarser) {
    levels_.emplace_back(points, time);
    for (const CoarserLevel& next : coarser) levels_.emplace_back(next.level, time);
  }

  // Replaces x by the solution y of A y = M x, to 1e-4 of x: in the norm of A, for which the preconditioned
  // residual stands, and so in the root mean square over the surface. Throws Cancelled where `progress`,
  // which may be null, asks for it.
  void step(std::vector<Value>& x, Progress* progress) {
    const HeatMatrix<Value>& matrix = levels_.front().matrix;
    const std::size_t count = matrix.size();
    const auto each = [count](const auto& body) { tbb::parallel_for(std::size_t{0}, count, body); };
    const auto sum = [count](const auto& term) { return ordered_sum(count, term); };
    std::vector<Value> image(count);
    std::vector<Value> residual(count);
    each([&](std::size_t i) { residual[i] = matrix.mass(i) * x[i]; });
    const double wanted = kError * kError * sum([&](std::size_t i) { return product(residual[i], x[i]); });
    // From x itself, which constants and isolated values are the solution of, without its finest detail.
    for (int round = 0; round < kFirstRounds; ++round) matrix.relax(residual, x, image);
    each([&](std::size_t i) { residual[i] -= matrix.row(x, i); });
    cycle(0, residual);
    std::vector<Value> direction = levels_.front().solution;
    const auto error = [&] {
      return sum([&](std::size_t i) { return product(residual[i], levels_.front().solution[i]); });
    };
    double norm = error();
    for (int iteration = 0; iteration < kMostIterations && norm > wanted; ++iteration) {
      throw_if_cancelled(progress);
      each([&](std::size_t i) { image[i] = matrix.row(direction, i); });
      const double length = norm / sum([&](std::size_t i) { return product(direction[i], image[i]); });
      each([&](std::size_t i) {
        x[i] += length * direction[i];
        residual[i] -= length * image[i];
      });
      cycle(0, residual);
      const double next = error();
      const double ratio = next / norm;
      norm = next;
      const std::vector<Value>& solution = levels_.front().solution;
      each([&](std::size_t i) { direction[i] = solution[i] + ratio * direction[i]; });
    }
  }

 private:
  static constexpr double kError = 1e-4;
  static constexpr int kMostIterations = 2000;
  static constexpr int kFirstRounds = 3;
  static constexpr int kCoarsestRounds = 4;

  struct Level {
    Level(const SmoothingLevel& level, double time)
        : matrix(level, time), right(level.size()), solution(level.size()), scratch(level.size()) {}
    HeatMatrix<Value> matrix;
    std::vector<Value> right;
    std::vector<Value> solution;
    std::vector<Value> scratch;
  };

  // The sum of term(i), in an order that depends on the count only.
  template <typename Term>
  static double ordered_sum(std::size_t count, const Term& term) {
    constexpr std::size_t kGrain = 4096;
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, count, kGrain), 0.0,
        [&](const tbb::blocked_range<std::size_t>& range, double sum) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) sum += term(i);
          return sum;
        },
        std::plus<>());
  }

  // A symmetric approximation of the solution of A x = b, in the level's `solution`.
  void cycle(std::size_t index, const std::vector<Value>& b) {
    Level& fine = levels_[index];
    fine.matrix.relax_zero(b, fine.solution);
    if (index == coarser_.size()) {
      for (int round = 1; round < kCoarsestRounds; ++round) fine.matrix.relax(b, fine.solution, fine.scratch);
      return;
    }
    Level& coarse = levels_[index + 1];
    const CoarserLevel& clusters = coarser_[index];
    const Carry carry{clusters.turns};
    tbb::parallel_for(std::size_t{0}, b.size(), [&](std::size_t p) {
      fine.scratch[p] = carry.back(b[p] - fine.matrix.row(fine.solution, p), p);
    });
    std::fill(coarse.right.begin(), coarse.right.end(), Value());
    for (std::size_t p = 0; p < b.size(); ++p) coarse.right[clusters.cluster_of[p]] += fine.scratch[p];
    cycle(index + 1, coarse.right);
    tbb::parallel_for(std::size_t{0}, b.size(), [&](std::size_t p) {
      fine.solution[p] += carry(coarse.solution[clusters.cluster_of[p]], p);
    });
    fine.matrix.relax(b, fine.solution, fine.scratch);
  }

  std::span<const CoarserLevel> coarser_;
  std::vector<Level> levels_;
};

}  // namespace solidnoise
