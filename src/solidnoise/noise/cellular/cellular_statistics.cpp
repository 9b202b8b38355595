#include "solidnoise/noise/cellular/cellular_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/radial_band.h"

namespace solidnoise {
namespace {

using Feature = CellularNoiseOptions::Feature;

// A smooth function on [0, end], interpolated from its values at Chebyshev's points by the barycentric
// formula (Berrut and Trefethen 2004, section 5).
class ChebyshevTable {
 public:
  template <typename Function>
  ChebyshevTable(const Function& function, double end, int degree) : end_(end) {
    for (int i = 0; i <= degree; ++i) {
      places_.push_back(0.5 * end * (1.0 - std::cos(kPi * i / degree)));
      values_.push_back(function(places_.back()));
    }
  }

  double end() const { return end_; }

  double operator()(double x) const {
    double above = 0.0;
    double below = 0.0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double distance = x - places_[i];
      if (distance == 0.0) return values_[i];
      const double half = i == 0 || i + 1 == places_.size() ? 0.5 : 1.0;
      const double weight = (i % 2 == 0 ? half : -half) / distance;
      above += weight * values_[i];
      below += weight;
    }
    return above / below;
  }

 private:
  double end_;
  std::vector<double> places_;
  std::vector<double> values_;
};

// The integral of sin^n from 0 to `angle`.
double sine_power_integral(int n, double angle) {
  const double c = std::cos(angle);
  switch (n) {
    case 1:
      return 1.0 - c;
    case 2:
      return 0.5 * (angle - std::sin(angle) * c);
    case 3:
      return 2.0 / 3.0 - c + c * c * c / 3.0;
    default:
      return 0.375 * angle - 0.25 * std::sin(2.0 * angle) + std::sin(4.0 * angle) / 32.0;
  }
}

// Of a ball of radius r, what lies beyond a plane x from its centre, |x| <= r.
double cap_volume(int n, double r, double x) {
  const double section = n == 1 ? 1.0 : unit_ball_volume(n - 1);
  return section * std::pow(r, n) * sine_power_integral(n, std::acos(std::clamp(x / r, -1.0, 1.0)));
}

// What the balls of radii r and s share whose surfaces meet, d apart.
double shared_volume(int n, double r, double s, double d) {
  const double x = (d * d + r * r - s * s) / (2.0 * d);
  return cap_volume(n, r, x) + cap_volume(n, s, d - x);
}

// The integrand of the covariance: of balls of volumes a and b that share a volume.
double mean_product(Feature feature, double a, double b, double shared) {
  const double apart = std::exp(-(a + b));
  const double together = std::exp(-(a + b - shared));
  if (feature == Feature::distance) return together - apart;
  return together * ((a - shared) * (b - shared) + shared) - apart * a * b;
}

// The radius of balls that all but never hold fewer than two points.
template <int Dim>
double radius_of_points(double expected) {
  return std::pow(expected / unit_ball_volume(Dim), 1.0 / Dim);
}

// In u = r + s and v = |r - s|: balls are apart for u < d, and there the integrand is 0; they meet for v < d
// < u, and beyond that one is inside the other.
template <int Dim>
double integrate_covariance(Feature feature, double d) {
  const double ball = unit_ball_volume(Dim);
  const double end = 2.0 * radius_of_points<Dim>(45.0);
  constexpr int kPanels = 2;
  const auto product = [&](double u, double v, const auto& shared) {
    const double r = 0.5 * (u + v);
    const double s = 0.5 * (u - v);
    return mean_product(feature, ball * std::pow(r, Dim), ball * std::pow(s, Dim), shared(r, s));
  };
  const auto lens = [&](double r, double s) { return shared_volume(Dim, r, s, d); };
  const auto smaller = [&](double, double s) { return ball * std::pow(s, Dim); };
  const double meeting = integrate(
      [&](double v) { return integrate([&](double u) { return product(u, v, lens); }, d, end, kPanels); },
      0.0, d);
  const double inside = integrate(
      [&](double v) { return integrate([&](double u) { return product(u, v, smaller); }, v, end, kPanels); },
      d, end, kPanels);
  return d == 0.0 ? inside : meeting + inside;
}

// Covariance and spectrum of a feature, up to where the one is 0 and the other falls as a power.
template <int Dim>
struct Tables {
  static constexpr double kHighest = 6.0;

  ChebyshevTable covariance;
  ChebyshevTable spectrum;

  explicit Tables(Feature feature)
      : covariance([&](double d) { return integrate_covariance<Dim>(feature, d); },
                   2.0 * radius_of_points<Dim>(15.0), 64),
        spectrum([this](double f) { return transform(f); }, kHighest,
                 static_cast<int>(kPi * kHighest * covariance.end()) + 40) {}

  double transform(double f) const {
    const int panels = 2 + static_cast<int>(f * covariance.end());
    return unit_sphere_area(Dim) * integrate(
                                       [&](double d) {
                                         return covariance(d) * mean_cosine(Dim, 2.0 * kPi * f * d) *
                                                std::pow(d, Dim - 1);
                                       },
                                       0.0, covariance.end(), panels);
  }
};

// Made on first use; they take some milliseconds.
template <int Dim>
const Tables<Dim>& tables(Feature feature) {
  if (feature == Feature::distance) {
    static const Tables<Dim> of_distance(Feature::distance);
    return of_distance;
  }
  static const Tables<Dim> of_border(Feature::border);
  return of_border;
}

}  // namespace

template <int Dim>
double CellularStatistics<Dim>::moment(int power) const {
  const double n = Dim;
  const double scale = std::pow(unit_ball_volume(Dim), -power / n);
  if (feature_ == Feature::distance) return scale * std::tgamma(1.0 + power / n);
  double sum = 0.0;
  double binomial = 1.0;
  for (int j = 0; j <= power; ++j) {
    sum += (j % 2 == 0 ? binomial : -binomial) * n / (n + j);
    binomial *= static_cast<double>(power - j) / (j + 1);
  }
  return scale * std::tgamma(2.0 + power / n) * sum;
}

template <int Dim>
double CellularStatistics<Dim>::variance() const {
  return moment(2) - squared(mean());
}

template <int Dim>
double CellularStatistics<Dim>::excess_kurtosis() const {
  const double m = mean();
  const double fourth = moment(4) - 4.0 * m * moment(3) + 6.0 * m * m * moment(2) - 3.0 * squared(m * m);
  return fourth / squared(variance()) - 3.0;
}

template <int Dim>
double CellularStatistics<Dim>::covariance(double d) const {
  const ChebyshevTable& table = tables<Dim>(feature_).covariance;
  return d < table.end() ? table(d) : 0.0;
}

template <int Dim>
double CellularStatistics<Dim>::power_spectrum(double f) const {
  const ChebyshevTable& table = tables<Dim>(feature_).spectrum;
  return f <= table.end() ? table(f) : table(table.end()) * std::pow(table.end() / f, Dim + 3);
}

template <int Dim>
Band CellularStatistics<Dim>::band() const {
  constexpr double kHighest = 40.0;  // the power above falls as f^-3: the rest has some 1e-6 of the variance
  constexpr double kPanel = 0.125;
  return radial_band([&](double f) { return std::pow(f, Dim - 1) * power_spectrum(f); },
                     variance() / unit_sphere_area(Dim), kHighest, kPanel);
}

template class CellularStatistics<1>;
template class CellularStatistics<2>;
template class CellularStatistics<3>;
template class CellularStatistics<4>;

}  // namespace solidnoise
