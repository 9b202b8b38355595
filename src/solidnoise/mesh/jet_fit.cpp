#include "solidnoise/mesh/jet_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace solidnoise {
namespace {

constexpr std::size_t kMostPerPoint = 48;
constexpr std::size_t kMostPerRing = 96;
constexpr int kMostRings = 8;

}  // namespace

const std::vector<std::uint32_t>& RingSearch::around(std::uint32_t centre, std::size_t count) {
  if (++search_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    search_ = 1;
  }
  found_.clear();
  seen_[centre] = search_;
  add_neighbours(centre);
  std::size_t begin = 0;
  for (int ring = 2; ring <= kMostRings && begin < found_.size(); ++ring) {
    if (ring > 2 && found_.size() >= count) break;
    const std::size_t end = found_.size();
    add_ring(begin);
    begin = end;
  }
  return found_;
}

void RingSearch::add_ring(std::size_t begin) {
  const std::size_t end = found_.size();
  for (std::size_t i = begin; i < end; ++i) add_neighbours(found_[i]);
  const std::size_t added = found_.size() - end;
  if (added <= kMostPerRing) return;
  for (std::size_t i = 0; i < kMostPerRing; ++i) found_[end + i] = found_[end + i * added / kMostPerRing];
  found_.resize(end + kMostPerRing);
}

void RingSearch::add_neighbours(std::uint32_t point) {
  const auto neighbours = neighbours_[point];
  const std::size_t taken = std::min(neighbours.size(), kMostPerPoint);
  for (std::size_t i = 0; i < taken; ++i) {
    const std::uint32_t other = neighbours[i * neighbours.size() / taken];
    if (seen_[other] == search_) continue;
    seen_[other] = search_;
    found_.push_back(other);
  }
}

namespace {

// A polynomial's derivatives at the origin.
struct Jet {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

// All monomials to degree 2 or 3, scaled so that coefficients are derivatives.
template <int Size>
Eigen::Matrix<double, Size, 1> monomials(double x, double y) {
  Eigen::Matrix<double, Size, 1> row;
  row.template head<6>() << 1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y;
  if constexpr (Size == 10) row.template tail<4>() << x * x * x, x * x * y, x * y * y, y * y * y;
  return row;
}

// Coordinates of the tangent plane in which the neighbours lie around the origin alike in all directions, at
// distances of about 1: the fit is then as good for long thin triangles as for equilateral ones.
struct RoundCoordinates {
  Eigen::Matrix2d to_round;

  // Scales along the axes of the neighbours' second moments; one scale if there is only one place.
  explicit RoundCoordinates(std::span<const Neighbour> neighbours) {
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    double weights = 0.0;
    for (const auto& [offset, weight] : neighbours) {
      const Eigen::Vector2d p(offset.x, offset.y);
      moments += weight * p * p.transpose();
      weights += weight;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(moments / weights);
    constexpr double kThinnest = 1e-4;
    const double longest = std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
    const double shortest = std::max(std::sqrt(std::max(axes.eigenvalues()[0], 0.0)), kThinnest * longest);
    const Eigen::Vector2d scales(1.0 / shortest, 1.0 / longest);
    to_round = scales.asDiagonal() * axes.eigenvectors().transpose();
  }

  Eigen::Vector2d operator()(const Vec<3>& offset) const {
    return to_round * Eigen::Vector2d(offset.x, offset.y);
  }

  // The derivatives in the plane of what has these derivatives in round coordinates.
  Jet in_plane(const Eigen::Vector2d& first, double xx, double xy, double yy) const {
    const Eigen::Vector2d slope = to_round.transpose() * first;
    const Eigen::Matrix2d second =
        to_round.transpose() * (Eigen::Matrix2d() << xx, xy, xy, yy).finished() * to_round;
    return {slope[0], slope[1], second(0, 0), second(0, 1), second(1, 1)};
  }
};

// What neighbours add to the sums of a fit.
template <int Size>
struct WeightedRow {
  Eigen::Matrix<double, Size, 1> row;
  Eigen::Matrix<double, Size, 1> weighted;
};

// Adds weighted row^T for each row to the lower triangle, whose columns stay in registers meanwhile.
template <int Size, int Column = 0>
void add_products(std::span<const WeightedRow<Size>> rows, Eigen::Matrix<double, Size, Size>& sums) {
  constexpr int kCount = Size - Column / 2 * 2;  // from an even row on, so that they load in pairs
  Eigen::Matrix<double, kCount, 1> sum = sums.col(Column).template tail<kCount>();
  for (const auto& [row, weighted] : rows) sum += row[Column] * weighted.template tail<kCount>();
  sums.col(Column).template tail<kCount>() = sum;
  if constexpr (Column + 1 < Size) add_products<Size, Column + 1>(rows, sums);
}

// What systems of equations are solved in: ten at each point, fewer at few, in types that others use, too.
template <int Size>
using SystemMatrix = std::conditional_t<Size == 10, Eigen::Matrix<double, Size, Size>, Eigen::MatrixXd>;
template <int Size>
using SystemVector = std::conditional_t<Size == 10, Eigen::Matrix<double, Size, 1>, Eigen::VectorXd>;

// No value if the neighbours do not determine the polynomial.
template <int Size>
std::optional<Jet> fit_polynomial(std::span<const Neighbour> neighbours, const RoundCoordinates& round) {
  // The point itself has the weight of its nearest neighbours, 1.
  Eigen::Matrix<double, Size, Size> normal_matrix = Eigen::Matrix<double, Size, Size>::Zero();
  Eigen::Matrix<double, Size, 1> right = Eigen::Matrix<double, Size, 1>::Zero();
  normal_matrix(0, 0) = 1.0;
  constexpr std::size_t kAtOnce = 32;
  std::array<WeightedRow<Size>, kAtOnce> rows;
  for (std::size_t first = 0; first < neighbours.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, neighbours.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d p = round(neighbours[first + i].offset);
      rows[i].row = monomials<Size>(p[0], p[1]);
    }
    // Apart: the processor waits where it reads in pairs what it has just written one by one.
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [offset, weight] = neighbours[first + i];
      rows[i].weighted = weight * rows[i].row;
      right += offset.z * rows[i].weighted;
    }
    add_products<Size>(std::span(rows).first(count), normal_matrix);
  }
  const Eigen::LDLT<SystemMatrix<Size>> factors(normal_matrix);
  constexpr double kSingular = 1e-7;
  const auto pivots = factors.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return std::nullopt;
  const SystemVector<Size> c = factors.solve(SystemVector<Size>(right));
  return round.in_plane({c[1], c[2]}, c[3], c[4], c[5]);
}

Jet fit_without_slope(std::span<const Neighbour> neighbours, const RoundCoordinates& round) {
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Neighbour& neighbour : neighbours) {
    const Eigen::Vector2d p = round(neighbour.offset);
    const Eigen::Vector3d row(0.5 * p[0] * p[0], p[0] * p[1], 0.5 * p[1] * p[1]);
    normal_matrix += neighbour.weight * row * row.transpose();
    right += neighbour.weight * neighbour.offset.z * row;
  }
  // Decides what the neighbours do not, and changes the rest by its share only.
  constexpr double kRidge = 1e-6;
  normal_matrix.diagonal().array() += kRidge * normal_matrix.trace();
  const Eigen::VectorXd c = Eigen::MatrixXd(normal_matrix).ldlt().solve(Eigen::VectorXd(right));
  return round.in_plane(Eigen::Vector2d::Zero(), c[0], c[1], c[2]);
}

ShapeOperator shape_of(const Jet& jet) {
  // With the unit normal n = (-z_x, -z_y, 1) / s, the frame's axes turn to u_k = e_k - n_k / (1 + n_z) (n +
  // e_z) in the surface's tangent plane, and the operator is -(second derivatives)(u_k, u_l) / s.
  const double s = std::sqrt(1.0 + jet.x * jet.x + jet.y * jet.y);
  const Vec<3> n(-jet.x / s, -jet.y / s, 1.0 / s);
  const double q = 1.0 / (1.0 + n.z);
  const Vec<2> u(1.0 - q * n.x * n.x, -q * n.x * n.y);
  const Vec<2> v(-q * n.x * n.y, 1.0 - q * n.y * n.y);
  const auto bend = [&](const Vec<2>& a, const Vec<2>& b) {
    return -(jet.xx * a.x * b.x + jet.xy * (a.x * b.y + a.y * b.x) + jet.yy * a.y * b.y) / s;
  };
  const double uu = bend(u, u);
  const double vv = bend(v, v);
  return {0.5 * (uu + vv), {0.5 * (uu - vv), bend(u, v)}};
}

}  // namespace

ShapeOperator fit_shape(std::span<const Neighbour> neighbours) {
  const bool in_plane = std::any_of(neighbours.begin(), neighbours.end(), [](const Neighbour& neighbour) {
    return neighbour.weight > 0.0 && (neighbour.offset.x != 0.0 || neighbour.offset.y != 0.0);
  });
  if (!in_plane) return {};
  const RoundCoordinates round(neighbours);
  constexpr std::size_t kForCubic = 13;
  constexpr std::size_t kForQuadric = 7;
  std::optional<Jet> jet;
  if (neighbours.size() >= kForCubic) jet = fit_polynomial<10>(neighbours, round);
  if (!jet && neighbours.size() >= kForQuadric) jet = fit_polynomial<6>(neighbours, round);
  return shape_of(jet ? *jet : fit_without_slope(neighbours, round));
}

}  // namespace solidnoise
