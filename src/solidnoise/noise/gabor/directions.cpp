#include "solidnoise/noise/gabor/directions.h"

#include <cmath>
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

// The angle p in [0, pi/2] with p - sin p cos p = target, by Newton's method from the small-angle solution;
// in 4D the left side is proportional to the share of the sphere within p of the axis.
double invert_cap_area_in_4d(double target) {
  double angle = std::min(std::cbrt(1.5 * target), 0.5 * pi);
  for (int step = 0; step < 8; ++step) {
    const double sine = std::sin(angle);
    if (sine == 0.0) break;
    angle -= (angle - sine * std::cos(angle) - target) / (2.0 * sine * sine);
  }
  return angle;
}

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
  double angle = 0.0;
  if constexpr (Dim == 2) angle = 0.5 * pi * covered;
  if constexpr (Dim == 4) angle = invert_cap_area_in_4d(0.5 * pi * covered);
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
