#include "solidnoise/noise/wave_mixture.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <numbers>

#include "solidnoise/core/numerics.h"

namespace solidnoise {
namespace {

constexpr double kRadiansPerCycle = 2.0 * std::numbers::pi;
constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr int kNodes = 10;  // per coordinate of a direction

// Nodes and weights on [0, 1].
const QuadratureRule& unit_rule() {
  static const QuadratureRule rule = [] {
    QuadratureRule unit = gauss_legendre(kNodes);
    for (double& node : unit.nodes) node = 0.5 * (1.0 + node);
    for (double& weight : unit.weights) weight *= 0.5;
    return unit;
  }();
  return rule;
}

}  // namespace

template <int Dim>
double WaveMixture<Dim>::variance() const {
  double sum = 0.0;
  for (const Wave& wave : waves) sum += wave.variance;
  return sum;
}

template <int Dim>
double WaveMixture<Dim>::envelope_correlation(double x) const {
  return std::exp(-kQuarter * a * a * x * x);
}

template <int Dim>
double WaveMixture<Dim>::covariance(const Vec<Dim>& x) const {
  double sum = 0.0;
  for (const Wave& wave : waves) {
    double angle = 0.0;
    double product = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      const double along_axis = kRadiansPerCycle * wave.frequency[axis] * x[axis];
      angle += along_axis;
      product *= symmetry == Symmetry::mirror ? std::cos(along_axis) : 1.0;
    }
    sum += wave.variance * (symmetry == Symmetry::mirror ? product : std::cos(angle));
  }
  for (int axis = 0; axis < Dim; ++axis) sum *= envelope_correlation(x[axis]);
  return sum;
}

template <int Dim>
double WaveMixture<Dim>::slope_variance(const Wave& wave, int axis) const {
  const double turns = kRadiansPerCycle * wave.frequency[axis];
  return turns * turns + std::numbers::pi * a * a;
}

template <int Dim>
AxisCovariance WaveMixture<Dim>::along(int axis, double step, int count) const {
  // Quadratures over directions have many waves of one frequency along an axis.
  struct Together {
    double variance = 0.0;
    double lateral = 0.0;  // the mean square of their derivatives along the other axes
  };
  std::map<double, Together> by_frequency;
  for (const Wave& wave : waves) {
    Together& together = by_frequency[wave.frequency[axis]];
    together.variance += wave.variance;
    for (int other = 0; other < Dim; ++other) {
      if (other != axis) together.lateral += wave.variance * slope_variance(wave, other);
    }
  }

  const auto size = static_cast<std::size_t>(count);
  AxisCovariance sums;
  for (auto* of : {&sums.value, &sums.value_to_slope, &sums.slope, &sums.lateral}) of->resize(size);
  for (const auto& [frequency, together] : by_frequency) {
    const auto [variance, lateral] = together;
    const double turns = kRadiansPerCycle * frequency;
    const std::complex<double> turn = std::polar(1.0, turns * step);
    std::complex<double> phasor(1.0);
    for (std::size_t k = 0; k < size; ++k, phasor *= turn) {
      sums.value[k] += variance * phasor.real();
      sums.lateral[k] += lateral * phasor.real();
      sums.value_to_slope[k] -= variance * turns * phasor.imag();
      sums.slope[k] += variance * turns * turns * phasor.real();
    }
  }
  // The derivatives of the product of these and rho, for which rho' = -b x rho.
  const double b = std::numbers::pi * a * a;
  for (std::size_t k = 0; a > 0.0 && k < size; ++k) {
    const double x = static_cast<double>(k) * step;
    const double envelope = envelope_correlation(x);
    sums.slope[k] = envelope * (sums.slope[k] + b * (1.0 - b * x * x) * sums.value[k] +
                                2.0 * b * x * sums.value_to_slope[k]);
    sums.value_to_slope[k] = envelope * (sums.value_to_slope[k] - b * x * sums.value[k]);
    sums.value[k] *= envelope;
    sums.lateral[k] *= envelope;
  }
  return sums;
}

template <int Dim>
std::vector<WeightedDirection<Dim>> mirrored_directions() {
  const QuadratureRule& rule = unit_rule();
  std::vector<WeightedDirection<Dim>> directions;
  const auto for_each_node = [&](const auto& visit) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) visit(rule.nodes[i], rule.weights[i]);
  };
  if constexpr (Dim == 1) directions.push_back({Vec<1>(1.0), 1.0});
  if constexpr (Dim == 2) {
    for_each_node([&](double u, double weight) {
      directions.push_back({{std::cos(kQuarter * u), std::sin(kQuarter * u)}, weight});
    });
  }
  if constexpr (Dim == 3) {
    // The height over a plane is uniform (Archimedes).
    for_each_node([&](double height, double of_height) {
      const double width = std::sqrt(1.0 - height * height);
      for_each_node([&](double u, double weight) {
        directions.push_back(
            {{width * std::cos(kQuarter * u), width * std::sin(kQuarter * u), height}, of_height * weight});
      });
    });
  }
  if constexpr (Dim == 4) {
    // The squared length in the first two coordinates is uniform, and so are the directions in each two.
    for_each_node([&](double share, double of_share) {
      for_each_node([&](double u, double of_u) {
        for_each_node([&](double v, double of_v) {
          const double first = std::sqrt(share);
          const double second = std::sqrt(1.0 - share);
          directions.push_back({{first * std::cos(kQuarter * u), first * std::sin(kQuarter * u),
                                 second * std::cos(kQuarter * v), second * std::sin(kQuarter * v)},
                                of_share * of_u * of_v});
        });
      });
    });
  }
  return directions;
}

template struct WaveMixture<1>;
template struct WaveMixture<2>;
template struct WaveMixture<3>;
template struct WaveMixture<4>;
template std::vector<WeightedDirection<1>> mirrored_directions<1>();
template std::vector<WeightedDirection<2>> mirrored_directions<2>();
template std::vector<WeightedDirection<3>> mirrored_directions<3>();
template std::vector<WeightedDirection<4>> mirrored_directions<4>();

}  // namespace solidnoise
