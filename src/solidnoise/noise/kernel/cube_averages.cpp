#include "solidnoise/noise/kernel/cube_averages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <utility>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(kPi * x) / (kPi * x);
}

// A function of frequency times side from a table, to 1e-4; 0 from u = kMost on.
struct ResponseTable {
  static constexpr int kMost = 6;
  static constexpr int kPerUnit = 256;

  double operator()(double u) const {
    if (u >= kMost) return 0.0;
    const double at = u * kPerUnit;
    const auto k = static_cast<std::size_t>(at);
    const double blend = at - static_cast<double>(k);
    return (1.0 - blend) * values[k] + blend * values[k + 1];
  }

  std::array<double, kMost * kPerUnit + 1> values;
};

// Means over the unit directions d of n dimensions, 1 to 4, of the product of sinc^2(u d_i), of independent
// places, or of sinc(2 u d_i): of two factors of fewer dimensions. In four dimensions the squared length in
// the first two coordinates is uniform, in three a coordinate is.
struct Responses {
  explicit Responses(Places places);

  std::array<ResponseTable, 4> tables;
};
Responses::Responses(Places places) {
  const auto factor = [&](std::size_t n, double u) {
    if (n > 1) return tables[n - 1](u);
    return places == Places::independent ? squared(sinc(u)) : sinc(2.0 * u);
  };
  const QuadratureRule rule = gauss_legendre(32);  // of more nodes than the cycles take
  for (std::size_t n = 1; n <= tables.size(); ++n) {
    for (int k = 0; k <= ResponseTable::kMost * ResponseTable::kPerUnit; ++k) {
      const double u = static_cast<double>(k) / ResponseTable::kPerUnit;
      double mean = n == 1 ? factor(1, u) : 0.0;
      for (std::size_t i = 0; n > 1 && i < rule.nodes.size(); ++i) {
        const double t = 0.5 + 0.5 * rule.nodes[i];
        const double one = n == 2 ? std::cos(0.25 * kPi * t) : n == 3 ? t : std::sqrt(t);
        const double other = std::sqrt(1.0 - one * one);
        mean += 0.5 * rule.weights[i] * factor(n / 2, u * one) * factor(n - n / 2, u * other);
      }
      tables[n - 1].values[static_cast<std::size_t>(k)] = mean;
    }
  }
}

const ResponseTable& response_of(int n, Places places) {
  static const std::array of{Responses(Places::independent), Responses(Places::mirrored)};
  return of[static_cast<std::size_t>(places)].tables[static_cast<std::size_t>(n - 1)];
}

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
double RadialAverages::mean(double side, Places places) const {
  const ResponseTable& response = response_of(dimensions_, places);
  double sum = dimensions_ == 1 ? 0.5 * squared(transform_[0]) : 0.0;
  for (std::size_t k = 1; k < transform_.size(); ++k) {
    const double f = static_cast<double>(k) * step_;
    sum += std::pow(f, dimensions_ - 1) * squared(transform_[k]) * response(f * side);
  }
  // In two dimensions the integrand begins with a slope.
  if (dimensions_ == 2) sum += step_ / 12.0 * squared(transform_[0]);
  return unit_sphere_area(dimensions_) * step_ * sum;
}

// The transform of (h * M)^2 at a frequency along an axis is the convolution of that of h * M with itself; of
// mirrored places that of M's with itself, times the cube's at the difference of the two frequencies.
double RadialAverages::coefficient(double side, Places places, int k) const {
  if (k == 0) return mean(side, places);
  std::vector<double> across;  // weights of the frequencies across
  for (std::size_t j = 0; j < transform_.size(); ++j) {
    const double f = static_cast<double>(j) * step_;
    if (dimensions_ == 1) {
      across.push_back(j == 0 ? 1.0 : 0.0);
    } else {
      const double trapezoid = j == 0 && dimensions_ == 2 ? 0.5 : 1.0;
      across.push_back(trapezoid * step_ * unit_sphere_area(dimensions_ - 1) * std::pow(f, dimensions_ - 2) *
                       response_of(dimensions_ - 1, places)(f * side));
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
    const double response = places == Places::independent ? sinc(side * along) * sinc(side * other)
                                                          : sinc(side * (other - along));
    sum += response * around;
  }
  return sum * step_;
}

namespace {

// Of one axis, the mean of M around one place of a cube times M around the other, times the step: at equal
// steps, some number of them to a side.
struct AxisMeans {
  AxisMeans(const std::function<double(double)>& mean_square, double reach, double side, Places places) {
    constexpr int kLeast = 256;  // steps over the reach
    const int per_side = std::max(8, static_cast<int>(std::ceil(kLeast * side / reach)));
    step = side / per_side;
    const int half = static_cast<int>(std::ceil(reach / step));
    const auto beside = static_cast<std::size_t>(per_side);  // zeros on either side
    // At the midpoints of steps.
    std::vector<double> values(2 * (beside + static_cast<std::size_t>(half)), 0.0);
    for (int k = -half; k < half; ++k) {
      const double x = std::abs((k + 0.5) * step);
      if (x < reach) values[beside + static_cast<std::size_t>(half + k)] = mean_square(x);
    }
    means.resize(values.size() - beside + 1, 0.0);
    if (places == Places::independent) {
      double sum = 0.0;  // of the values of a side
      for (std::size_t k = 0; k < means.size(); ++k) {
        means[k] = step * squared(sum / per_side);
        if (k + 1 < means.size()) sum += values[k + beside] - values[k];
      }
      return;
    }
    for (std::size_t k = 0; 2 * k < means.size(); ++k) {
      double mean = 0.0;
      for (std::size_t i = 0; i < beside; ++i) mean += values[k + beside - 1 - i] * values[k + i] / per_side;
      means[k] = means[means.size() - 1 - k] = step * mean;
    }
  }

  double sum() const {
    double total = 0.0;
    for (const double value : means) total += value;
    return total;
  }

  double step;
  std::vector<double> means;
};

}  // namespace

double ProductAverages::coefficient(double side, Places places, int k) const {
  const AxisMeans axis(of_axis_, reach_, side, places);
  const double middle = 0.5 * static_cast<double>(axis.means.size() - 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < axis.means.size(); ++i) {
    const double x = (static_cast<double>(i) - middle) * axis.step;
    sum += axis.means[i] * std::cos(2.0 * kPi * k * x / side);
  }
  return factor_ * factor_ * sum * std::pow(axis.sum(), dimensions_ - 1);
}

LayerAverages::LayerAverages(RadialAverages in_plane, const std::function<double(double)>& across,
                             double thickness)
    : in_plane_(std::move(in_plane)),
      across_(RadialAverages::of(1, across, thickness, kHighestAcross / thickness)) {}

// Mean over the orientations of the layer, that is over directions of frequencies.
double LayerAverages::coefficient(double side, Places places, int k) const {
  if (k > 0) return in_plane_.mean(side, places) * across_.coefficient(side, places, k);
  const ResponseTable& response = response_of(3, places);
  const std::vector<double>& plane = in_plane_.transform_;
  const std::vector<double>& normal = across_.transform_;
  double sum = 0.0;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const double z = static_cast<double>(i) * across_.step_;
    const double both_signs = i == 0 ? 1.0 : 2.0;
    for (std::size_t j = 1; j < plane.size(); ++j) {
      const double f = static_cast<double>(j) * in_plane_.step_;
      sum += both_signs * squared(normal[i]) * f * squared(plane[j]) * response(side * std::hypot(f, z));
    }
  }
  return 2.0 * kPi * in_plane_.step_ * across_.step_ * sum;
}

}  // namespace solidnoise
