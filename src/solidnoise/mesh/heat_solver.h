#pragma once

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

namespace solidnoise {

inline double product(double a, double b) {
  return a * b;
}
inline double product(const std::complex<double>& a, const std::complex<double>& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
inline double product(const Vec<3>& a, const Vec<3>& b) {
  return glm::dot(a, b);
}

// A value of one place as it is at another.
struct Carry {
  const std::vector<std::complex<float>>& turns;

  double operator()(double number, std::size_t) const { return number; }
  Vec<3> operator()(const Vec<3>& vector, std::size_t) const { return vector; }
  std::complex<double> operator()(const std::complex<double>& line, std::size_t entry) const {
    return turned(line, turns[entry].real(), turns[entry].imag());
  }

  // The way back.
  double back(double number, std::size_t) const { return number; }
  Vec<3> back(const Vec<3>& vector, std::size_t) const { return vector; }
  std::complex<double> back(const std::complex<double>& line, std::size_t entry) const {
    return turned(line, turns[entry].real(), -turns[entry].imag());
  }

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

  // What a round of Jacobi's method for A x = b makes of x at p, damped: with less than 1 every error
  // shrinks, for the eigenvalues of A over its diagonal lie between 0 and 2.
  Value relaxed(const std::vector<Value>& b, const std::vector<Value>& x, std::size_t p) const {
    return x[p] + relaxed_zero(b[p] - row(x, p), p);
  }
  // The same of x = 0, for b at p.
  Value relaxed_zero(const Value& b, std::size_t p) const { return (kDamping / diagonal_[p]) * b; }

 private:
  static constexpr double kDamping = 0.7;

  const SmoothingLevel& level_;
  const Carry carry_;
  const double time_;
  std::vector<double> masses_;
  std::vector<double> diagonal_;
};

// Implicit steps of the heat equation: conjugate gradients with a K-cycle of multigrid over the coarser
// levels (Notay and Vassilevski 2008), which takes about as many rounds for a long time as for a short one:
// values are constant in a cluster, which a V-cycle would pay for.
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
    Level& finest = levels_.front();
    const HeatMatrix<Value>& matrix = finest.matrix;
    std::vector<Value>& residual = finest.residual;
    each(x, [&](std::size_t i) { residual[i] = matrix.mass(i) * x[i]; });
    const double wanted =
        kError * kError * sum_each(x, [&](std::size_t i) { return product(residual[i], x[i]); });
    // From x itself, which constants and isolated values are the solution of, without its finest detail.
    for (int round = 0; round < kFirstRounds; ++round) {
      each(x, [&](std::size_t i) { finest.scratch[i] = matrix.relaxed(residual, x, i); });
      x.swap(finest.scratch);
    }
    each(x, [&](std::size_t i) { residual[i] -= matrix.row(x, i); });
    improve(0, x, {kMostRounds, wanted}, progress);
  }

 private:
  static constexpr double kError = 1e-4;
  static constexpr int kMostRounds = 2000;
  static constexpr int kFirstRounds = 3;
  static constexpr int kCoarseRounds = 2;
  static constexpr int kCoarsestRounds = 6;

  struct Level {
    Level(const SmoothingLevel& level, double time)
        : matrix(level, time),
          residual(level.size()),
          guess(level.size()),
          direction(level.size()),
          image(level.size()),
          scratch(level.size()) {}
    HeatMatrix<Value> matrix;
    std::vector<Value> residual;
    std::vector<Value> guess;  // of the solution for the residual
    std::vector<Value> direction;
    std::vector<Value> image;
    std::vector<Value> scratch;
    std::vector<Value> correction;  // of the next finer level's guess
  };

  template <typename Body>
  static void each(const std::vector<Value>& of, const Body& body) {
    tbb::parallel_for(std::size_t{0}, of.size(), body);
  }

  // The sum of what the body returns for each, in an order that depends on their number only.
  template <typename Body>
  static double sum_each(const std::vector<Value>& of, const Body& body) {
    constexpr std::size_t kGrain = 4096;
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, of.size(), kGrain), 0.0,
        [&](const tbb::blocked_range<std::size_t>& range, double sum) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) sum += body(i);
          return sum;
        },
        std::plus<>());
  }

  struct Ending {
    int rounds;
    double norm = 0.0;
  };

  // Adds to x what the level's residual, which becomes that of x, says that it lacks: conjugate gradients, of
  // the flexible kind (Notay 2000), for guesses are not linear in the residual.
  void improve(std::size_t index, std::vector<Value>& x, const Ending& ending, Progress* progress) {
    Level& level = levels_[index];
    double norm = make_guess(index);
    level.direction = level.guess;
    for (int round = 1; norm > ending.norm; ++round) {
      throw_if_cancelled(progress);
      const double energy = sum_each(x, [&](std::size_t i) {
        level.image[i] = level.matrix.row(level.direction, i);
        return product(level.direction[i], level.image[i]);
      });
      if (!(energy > 0.0)) return;  // of what is too small for a square
      const double length = norm / energy;
      const double left = sum_each(x, [&](std::size_t i) {
        x[i] += length * level.direction[i];
        level.residual[i] -= length * level.image[i];
        return product(level.residual[i], level.guess[i]);
      });
      if (round == ending.rounds) return;
      const double next = make_guess(index);
      const double ratio = (next - left) / norm;
      norm = next;
      each(x, [&](std::size_t i) { level.direction[i] = level.guess[i] + ratio * level.direction[i]; });
    }
  }

  // An approximation of the solution for a level's residual: relaxed, improved on the coarser levels,
  // relaxed. Returns the sum of the products of the two.
  double make_guess(std::size_t index) {
    Level& fine = levels_[index];
    const auto relax_zero = [&](std::size_t p) {
      fine.guess[p] = fine.matrix.relaxed_zero(fine.residual[p], p);
      return product(fine.residual[p], fine.guess[p]);
    };
    if (index == coarser_.size()) return sum_each(fine.guess, relax_zero);
    each(fine.guess, relax_zero);
    Level& coarse = levels_[index + 1];
    const CoarserLevel& clusters = coarser_[index];
    const Carry carry{clusters.turns};
    each(coarse.residual, [&](std::size_t c) {
      coarse.residual[c] = Value();
      for (const std::uint32_t p : clusters.places[c])
        coarse.residual[c] += carry.back(fine.residual[p] - fine.matrix.row(fine.guess, p), p);
    });
    coarse.correction.assign(coarse.residual.size(), Value());
    const bool is_coarsest = index + 1 == coarser_.size();
    improve(index + 1, coarse.correction, {is_coarsest ? kCoarsestRounds : kCoarseRounds}, nullptr);
    each(fine.guess,
         [&](std::size_t p) { fine.guess[p] += carry(coarse.correction[clusters.cluster_of[p]], p); });
    const double norm = sum_each(fine.guess, [&](std::size_t p) {
      fine.scratch[p] = fine.matrix.relaxed(fine.residual, fine.guess, p);
      return product(fine.residual[p], fine.scratch[p]);
    });
    fine.guess.swap(fine.scratch);
    return norm;
  }

  std::span<const CoarserLevel> coarser_;
  std::vector<Level> levels_;
};

}  // namespace solidnoise
