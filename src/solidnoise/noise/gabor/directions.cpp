#include "solidnoise/noise/gabor/directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "solidnoise/core/numerics.h"

namespace solidnoise {
namespace {

using std::numbers::pi;

// A uniform direction in Dim - 1 dimensions, of 3 or 4; unused coordinates are 0.
template <int Dim>
std::array<double, 3> draw_around(RandomStream& stream) {
  if constexpr (Dim == 3) {
    const double azimuth = 2.0 * pi * stream.next_unit();
    return {std::cos(azimuth), std::sin(azimuth), 0.0};
  }
  if constexpr (Dim == 4) {
    const double height = 2.0 * stream.next_unit() - 1.0;
    const double azimuth = 2.0 * pi * stream.next_unit();
    const double width = std::sqrt(1.0 - height * height);
    return {height, width * std::cos(azimuth), width * std::sin(azimuth)};
  }
  return {};
}

// Directions of Dim - 1 dimensions, with weights that add up to 1, whose mean is that of all directions.
template <int Dim>
std::vector<std::pair<std::array<double, 3>, double>> directions_around() {
  if constexpr (Dim == 2) return {{{-1.0, 0.0, 0.0}, 0.5}, {{1.0, 0.0, 0.0}, 0.5}};
  constexpr int kTurns = 24;
  std::vector<std::pair<std::array<double, 3>, double>> directions;
  const auto add_circle = [&](double height, double weight) {
    const double width = std::sqrt(1.0 - height * height);
    for (int k = 0; k < kTurns; ++k) {
      const double azimuth = 2.0 * pi * k / kTurns;
      const double cosine = width * std::cos(azimuth);
      const double sine = width * std::sin(azimuth);
      directions.push_back(
          {Dim == 3 ? std::array{cosine, sine, 0.0} : std::array{height, cosine, sine}, weight / kTurns});
    }
  };
  if constexpr (Dim == 3) add_circle(0.0, 1.0);
  if constexpr (Dim == 4) {
    const QuadratureRule rule = gauss_legendre(kTurns / 2);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) add_circle(rule.nodes[i], 0.5 * rule.weights[i]);
  }
  return directions;
}

// In 4D the share of the sphere within an angle p of the axis is (p - sin p cos p) / (pi / 2), which begins
// with its cube: cosine and sine are smooth functions of the cube root of the share. From a table, by cubic
// interpolation with their slopes, to 1e-12.
class CapAngles {
 public:
  static const CapAngles& in_4d() {
    static const CapAngles angles;
    return angles;
  }

  // For a root in [0, 1].
  std::pair<double, double> cosine_and_sine(double root) const {
    const double at = root * kSteps;
    const auto k = std::min(static_cast<std::size_t>(at), kSteps - 1);
    const double x = at - static_cast<double>(k);
    const Node& from = nodes_[k];
    const Node& to = nodes_[k + 1];
    const auto between = [x](double value, double slope, double next, double next_slope) {
      const double rise = next - value;
      return value + x * (slope + x * (3.0 * rise - 2.0 * slope - next_slope +
                                       x * (slope + next_slope - 2.0 * rise)));
    };
    return {between(from.cosine, -from.sine * from.slope, to.cosine, -to.sine * to.slope),
            between(from.sine, from.cosine * from.slope, to.sine, to.cosine * to.slope)};
  }

 private:
  static constexpr std::size_t kSteps = 1024;

  struct Node {
    double cosine, sine;
    double slope;  // of the angle, by steps of the root
  };

  CapAngles() {
    for (std::size_t k = 0; k <= kSteps; ++k) {
      const double root = static_cast<double>(k) / kSteps;
      const double area = 0.5 * pi * root * root * root;
      const double angle =
          k == 0 ? 0.0
                 : bisect([area](double p) { return p - std::sin(p) * std::cos(p) - area; }, 0.0, 0.5 * pi);
      const double sine = std::sin(angle);
      // 2 sin^2 p dp = (pi / 2) 3 root^2 d root; at 0, p^3 2/3 = root^3 pi / 2.
      const double ratio = k == 0 ? std::cbrt(4.0 / (3.0 * pi)) : root / sine;
      nodes_[k] = {std::cos(angle), sine, 0.75 * pi * ratio * ratio / kSteps};
    }
  }

  std::array<Node, kSteps + 1> nodes_;
};

}  // namespace

template <int Dim>
DirectionCone<Dim>::DirectionCone(const Vec<Dim>& axis, double anisotropy)
    : axis_(glm::normalize(axis)), anisotropy_(anisotropy), mirror_(0.0) {
  Vec<Dim> first(0.0);
  first[0] = 1.0;
  const Vec<Dim> difference = first - axis_;
  if (glm::length(difference) > 1e-12) mirror_ = glm::normalize(difference);
}

template <int Dim>
typename DirectionCone<Dim>::Polar DirectionCone<Dim>::polar_angle(double share) const {
  const double covered = share * (1.0 - anisotropy_);
  if constexpr (Dim == 3) {
    const double cosine = 1.0 - covered;
    return {cosine, std::sqrt(covered * (1.0 + cosine))};
  }
  if constexpr (Dim == 4) {
    const auto [cosine, sine] = CapAngles::in_4d().cosine_and_sine(std::cbrt(covered));
    return {cosine, sine};
  }
  const double angle = Dim == 2 ? 0.5 * pi * covered : 0.0;
  return {std::cos(angle), std::sin(angle)};
}

template <int Dim>
Vec<Dim> DirectionCone<Dim>::at(const Polar& polar, const std::array<double, 3>& around) const {
  Vec<Dim> direction(0.0);
  direction[0] = polar.cosine;
  for (int axis = 1; axis < Dim; ++axis) direction[axis] = polar.sine * around[axis - 1];
  return direction - 2.0 * glm::dot(direction, mirror_) * mirror_;
}

template <int Dim>
Vec<Dim> DirectionCone<Dim>::draw(double share, RandomStream& stream) const {
  if (Dim == 1 || anisotropy_ == 1.0) return axis_;
  if (Dim == 2) {
    const double side = 2.0 * share - 1.0;
    return at(polar_angle(std::abs(side)), {std::copysign(1.0, side), 0.0, 0.0});
  }
  return at(polar_angle(share), draw_around<Dim>(stream));
}

template <int Dim>
std::vector<WeightedDirection<Dim>> DirectionCone<Dim>::quadrature() const {
  if (Dim == 1 || anisotropy_ == 1.0) return {{axis_, 1.0}};
  if (anisotropy_ == 0.0) return mirrored_directions<Dim>();
  const QuadratureRule& rule = panel_rule();
  const auto around = directions_around<Dim>();
  std::vector<WeightedDirection<Dim>> directions;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const Polar polar = polar_angle(0.5 * (1.0 + rule.nodes[i]));
    for (const auto& [turn, weight] : around) {
      directions.push_back({at(polar, turn), 0.5 * rule.weights[i] * weight});
    }
  }
  return directions;
}

template <int Dim>
Vec<Dim> DirectionCone<Dim>::second_moments() const {
  double along = 1.0;  // the axis' own
  const Polar edge = polar_angle(1.0);
  if (Dim > 1 && edge.sine > 0.0) {
    const double widest = std::atan2(edge.sine, edge.cosine);
    const auto area = [](double angle) { return std::pow(std::sin(angle), Dim - 2); };
    along = integrate([&](double angle) { return std::pow(std::cos(angle), 2) * area(angle); }, 0.0, widest) /
            integrate(area, 0.0, widest);
  }
  const double across = Dim > 1 ? (1.0 - along) / (Dim - 1) : 0.0;
  return Vec<Dim>(across) + (along - across) * axis_ * axis_;
}

template class DirectionCone<1>;
template class DirectionCone<2>;
template class DirectionCone<3>;
template class DirectionCone<4>;

}  // namespace solidnoise
