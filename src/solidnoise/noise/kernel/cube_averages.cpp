#include "solidnoise/noise/kernel/cube_averages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(kPi * x) / (kPi * x);
}

// Mean over the unit directions d of n dimensions of the product of sinc^2(u d_i), with a rule of as many
// nodes as four cycles take. In four dimensions the squared length in the first two coordinates is uniform,
// in three a coordinate is.
double mean_response(int n, double u) {
  static const QuadratureRule rule = gauss_legendre(12);
  const auto mean = [](const auto& function) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += 0.5 * rule.weights[i] * function(0.5 + 0.5 * rule.nodes[i]);
    }
    return sum;
  };
  switch (n) {
    case 1:
      return squared(sinc(u));
    case 2:
      return mean([u](double turn) {
        const double angle = 0.25 * kPi * turn;
        return squared(sinc(u * std::cos(angle)) * sinc(u * std::sin(angle)));
      });
    case 3:
      return mean([u](double height) {
        return squared(sinc(u * height)) * mean_response(2, u * std::sqrt(1.0 - height * height));
      });
    default:
      return mean([u](double share) {
        return mean_response(2, u * std::sqrt(share)) * mean_response(2, u * std::sqrt(1.0 - share));
      });
  }
}

// The same from a table that is made once, to 1e-4; 0 from u = kMost on.
class ResponseTable {
 public:
  static const ResponseTable& of(int n) {
    static const std::array<ResponseTable, 4> tables{ResponseTable(1), ResponseTable(2), ResponseTable(3),
                                                     ResponseTable(4)};
    return tables[static_cast<std::size_t>(n - 1)];
  }

  double operator()(double u) const {
    if (u >= kMost) return 0.0;
    const double at = u * kPerUnit;
    const auto k = static_cast<std::size_t>(at);
    const double blend = at - static_cast<double>(k);
    return (1.0 - blend) * values_[k] + blend * values_[k + 1];
  }

 private:
  static constexpr int kMost = 6;
  static constexpr int kPerUnit = 128;

  explicit ResponseTable(int n) {
    for (int k = 0; k <= kMost * kPerUnit; ++k) {
      values_.push_back(mean_response(n, static_cast<double>(k) / kPerUnit));
    }
  }

  std::vector<double> values_;
};

}  // namespace

// M is nearly 0 at its reach, so that its transform is smooth over 1 / reach.
RadialAverages::RadialAverages(int dimensions, double reach, double highest,
                               const std::function<double(double)>& transform)
    : dimensions_(dimensions) {
  constexpr int kPerReach = 8;
  const int count = static_cast<int>(std::ceil(highest * reach * kPerReach)) + 2;
  step_ = 1.0 / (kPerReach * reach);
  for (int k = 0; k < count; ++k) transform_.push_back(transform(k * step_));
}

// Gaussian quadrature is exact for some two nodes per cycle.
RadialAverages RadialAverages::of(int dimensions, const std::function<double(double)>& mean_square,
                                  double reach, double highest) {
  const QuadratureRule& rule = panel_rule();
  const int panels = 1 + static_cast<int>(highest * reach / 4.0);
  std::vector<double> radii;
  std::vector<double> shells;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double half = 0.5 * reach / panels;
      const double r = half * (2 * panel + 1 + rule.nodes[i]);
      radii.push_back(r);
      shells.push_back(half * rule.weights[i] * unit_sphere_area(dimensions) * std::pow(r, dimensions - 1) *
                       mean_square(r));
    }
  }
  return RadialAverages(dimensions, reach, highest, [&](double frequency) {
    double sum = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      sum += shells[i] * mean_cosine(dimensions, 2.0 * kPi * frequency * radii[i]);
    }
    return sum;
  });
}

double RadialAverages::transform(double frequency) const {
  const double at = frequency / step_;
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= transform_.size()) return 0.0;
  const double blend = at - static_cast<double>(k);
  return (1.0 - blend) * transform_[k] + blend * transform_[k + 1];
}

// Trapezoids over frequencies: the integrand is smooth, and ends at 0.
double RadialAverages::overlap(double side) const {
  const ResponseTable& response = ResponseTable::of(dimensions_);
  double sum = dimensions_ == 1 ? 0.5 * squared(transform_[0]) : 0.0;
  for (std::size_t k = 1; k < transform_.size(); ++k) {
    const double f = static_cast<double>(k) * step_;
    sum += std::pow(f, dimensions_ - 1) * squared(transform_[k]) * response(f * side);
  }
  // In two dimensions the integrand begins with a slope.
  if (dimensions_ == 2) sum += step_ / 12.0 * squared(transform_[0]);
  return unit_sphere_area(dimensions_) * step_ * sum;
}

// The transform of (h * M)^2 at a frequency along an axis is the convolution of that of h * M with itself.
double RadialAverages::harmonic(double side, int k) const {
  std::vector<double> across;  // weights of the frequencies across
  for (std::size_t j = 0; j < transform_.size(); ++j) {
    const double f = static_cast<double>(j) * step_;
    if (dimensions_ == 1) {
      across.push_back(j == 0 ? 1.0 : 0.0);
    } else {
      const double trapezoid = j == 0 && dimensions_ == 2 ? 0.5 : 1.0;
      across.push_back(trapezoid * step_ * unit_sphere_area(dimensions_ - 1) * std::pow(f, dimensions_ - 2) *
                       ResponseTable::of(dimensions_ - 1)(f * side));
    }
  }
  const int size = static_cast<int>(transform_.size());
  // The first factor, times the weight, is that of a frequency along and of its opposite; it ends in a
  // circle.
  std::vector<std::vector<double>> rows(transform_.size() + 1);
  for (int i = 0; i <= size; ++i) {
    for (std::size_t j = 0; j < across.size(); ++j) {
      const double distance = std::hypot(i * step_, static_cast<double>(j) * step_);
      if (distance / step_ >= size - 1) break;
      rows[static_cast<std::size_t>(i)].push_back(across[j] * transform(distance));
    }
  }
  double sum = 0.0;
  for (int i = -size; i <= size; ++i) {
    const double along = i * step_;
    const double other = k / side - along;
    const std::vector<double>& row = rows[static_cast<std::size_t>(std::abs(i))];
    double around = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (row[j] == 0.0) continue;
      const double distance = std::hypot(other, static_cast<double>(j) * step_);
      if (distance / step_ >= size - 1) break;
      around += row[j] * transform(distance);
    }
    sum += sinc(side * along) * sinc(side * other) * around;
  }
  return sum * step_;
}

namespace {

// The square of h * M of one axis, times the step: at equal steps, some number of them to a side.
struct AxisMeans {
  AxisMeans(const std::function<double(double)>& mean_square, double reach, double side) {
    constexpr int kLeast = 256;  // steps over the reach
    const int per_side = std::max(8, static_cast<int>(std::ceil(kLeast * side / reach)));
    step = side / per_side;
    const int half = static_cast<int>(std::ceil(reach / step));
    std::vector<double> sums{0.0};  // integrals up to each step, by the midpoint rule
    for (int k = -half; k < half; ++k) {
      const double x = std::abs((k + 0.5) * step);
      sums.push_back(sums.back() + (x < reach ? step * mean_square(x) : 0.0));
    }
    const auto sum_to = [&](int k) { return sums[static_cast<std::size_t>(std::clamp(k, 0, 2 * half))]; };
    for (int k = 0; k <= 2 * half + per_side; ++k) {
      squares.push_back(step * squared((sum_to(k) - sum_to(k - per_side)) / side));
    }
  }

  double sum() const {
    double total = 0.0;
    for (const double value : squares) total += value;
    return total;
  }

  double step;
  std::vector<double> squares;
};

}  // namespace

double ProductAverages::overlap(double side) const {
  return factor_ * factor_ * std::pow(AxisMeans(of_axis_, reach_, side).sum(), dimensions_);
}

double ProductAverages::harmonic(double side, int k) const {
  const AxisMeans means(of_axis_, reach_, side);
  const double middle = 0.5 * static_cast<double>(means.squares.size() - 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < means.squares.size(); ++i) {
    const double x = (static_cast<double>(i) - middle) * means.step;
    sum += means.squares[i] * std::cos(2.0 * kPi * k * x / side);
  }
  return factor_ * factor_ * sum * std::pow(means.sum(), dimensions_ - 1);
}

LayerAverages::LayerAverages(RadialAverages in_plane, const std::function<double(double)>& across,
                             double thickness)
    : in_plane_(std::move(in_plane)),
      across_(RadialAverages::of(1, across, thickness, kHighestAcross / thickness)) {}

// Mean over the orientations of the layer, that is over directions of frequencies.
double LayerAverages::overlap(double side) const {
  const ResponseTable& response = ResponseTable::of(3);
  const std::vector<double>& plane = in_plane_.transform_;
  const std::vector<double>& normal = across_.transform_;
  double sum = 0.0;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const double z = static_cast<double>(i) * across_.step_;
    const double both_signs = i == 0 ? 1.0 : 2.0;
    for (std::size_t k = 1; k < plane.size(); ++k) {
      const double f = static_cast<double>(k) * in_plane_.step_;
      sum += both_signs * squared(normal[i]) * f * squared(plane[k]) * response(side * std::hypot(f, z));
    }
  }
  return 2.0 * kPi * in_plane_.step_ * across_.step_ * sum;
}

double LayerAverages::harmonic(double side, int k) const {
  return in_plane_.overlap(side) * across_.harmonic(side, k);
}

}  // namespace solidnoise
