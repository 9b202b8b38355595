#include "solidnoise/noise/gradient/gradient_kernel.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/radial_band.h"

namespace solidnoise {
namespace {

// Integral of r^q t^p over 0 <= r <= 2, t = 1 - r^2/4: a Beta function, by the substitution u = r^2/4.
double radial_moment(double q, double p) {
  return std::pow(2.0, q) * std::beta(0.5 * (q + 1.0), p + 1.0);
}

// The n-dimensional Fourier transform of t^p over the ball |x| < 2,
//   2^n pi^-p p! (2f)^-(n/2 + p) J_{n/2 + p}(4 pi f),
// written as its value at 0 times a mean cosine in n + 2p + 2 dimensions; and its derivative with respect to
// f.
double ball_power_at_zero(int n, int p) {
  return std::pow(2.0, n) * std::pow(kPi, 0.5 * n) * std::tgamma(p + 1.0) / std::tgamma(0.5 * n + p + 1.0);
}
double ball_power_transform(int n, int p, double f) {
  return ball_power_at_zero(n, p) * mean_cosine(n + 2 * p + 2, 4.0 * kPi * f);
}
double ball_power_transform_slope(int n, int p, double f) {
  const int dimensions = n + 2 * p + 2;
  return -ball_power_at_zero(n, p) * (16.0 * kPi * kPi * f / dimensions) *
         mean_cosine(dimensions + 2, 4.0 * kPi * f);
}

// How many points of the integer lattice have the squared length m, for m = 0 to `last`.
std::vector<double> lattice_points_by_norm(int dim, int last) {
  std::vector<double> counts(static_cast<std::size_t>(last) + 1, 0.0);
  counts[0] = 1.0;
  for (int axis = 0; axis < dim; ++axis) {
    std::vector<double> next = counts;
    for (int k = 1; k * k <= last; ++k) {
      for (int m = k * k; m <= last; ++m) {
        next[static_cast<std::size_t>(m)] += 2.0 * counts[static_cast<std::size_t>(m - k * k)];
      }
    }
    counts = next;
  }
  return counts;
}

}  // namespace

template <int Dim>
GradientKernel<Dim>::GradientKernel(Kernel kernel, Support support) {
  if (kernel == Kernel::zero_dc) {
    const double ratio = 5.0 / (0.5 * Dim + 6.0);
    c1_ = 1.0 / (1.0 - ratio);
    c2_ = ratio * c1_;
  }
  if (support == Support::half) {
    spacing_ = 2.0;
    density_ = std::pow(0.5, Dim);
  }
  radial_peak_ = find_radial_peak();
}

template <int Dim>
double GradientKernel<Dim>::value(double r) const {
  if (r >= kRadius) return 0.0;
  const double t = 1.0 - 0.25 * r * r;
  return squared(squared(t)) * (c1_ * t - c2_);
}

template <int Dim>
double GradientKernel<Dim>::mean_variance() const {
  const double n = Dim;
  const double integral = c1_ * c1_ * radial_moment(n + 1.0, 10.0) -
                          2.0 * c1_ * c2_ * radial_moment(n + 1.0, 9.0) +
                          c2_ * c2_ * radial_moment(n + 1.0, 8.0);
  return density_ * unit_sphere_area(Dim) / n * integral;
}

template <int Dim>
double GradientKernel<Dim>::mean_gradient_variance() const {
  const double n = Dim;
  const double integral = integrate(
      [&](double r) {
        const double t = 1.0 - 0.25 * r * r;
        const double s = value(r);
        const double r_slope = -0.5 * r * r * t * t * t * (5.0 * c1_ * t - 4.0 * c2_);  // r s'
        return std::pow(r, n - 1.0) * (n * s * s + 2.0 * s * r_slope + r_slope * r_slope);
      },
      0.0, kRadius);
  return density_ * unit_sphere_area(Dim) / (n * n) * integral;
}

template <int Dim>
double GradientKernel<Dim>::potential_transform(double f) const {
  return 0.4 * c2_ * ball_power_transform(Dim, 5, f) - c1_ / 3.0 * ball_power_transform(Dim, 6, f);
}

template <int Dim>
double GradientKernel<Dim>::potential_transform_slope(double f) const {
  return 0.4 * c2_ * ball_power_transform_slope(Dim, 5, f) -
         c1_ / 3.0 * ball_power_transform_slope(Dim, 6, f);
}

template <int Dim>
double GradientKernel<Dim>::power_spectrum(double f) const {
  return density_ * squared(2.0 * kPi * f * potential_transform(f)) / Dim;
}

template <int Dim>
double GradientKernel<Dim>::find_radial_peak() const {
  constexpr double kPower = Dim + 1.0;  // f^(n-1) S is f^(n+1) psi^2, up to a factor
  constexpr double kStep = 0.01;
  constexpr double kHighest = 1.5;  // past it, S is below 1e-4 of its peak in every dimension
  double best = 0.0;
  double peak = 0.0;
  for (double f = kStep; f < kHighest; f += kStep) {
    const double height = std::pow(f, kPower) * squared(potential_transform(f));
    if (height > best) {
      best = height;
      peak = f;
    }
  }
  // The derivative, up to the factor f^n psi, which has one sign near the peak.
  const auto slope = [&](double f) {
    return kPower * potential_transform(f) + 2.0 * f * potential_transform_slope(f);
  };
  return bisect(slope, peak - kStep, peak + kStep);
}

template <int Dim>
double GradientKernel<Dim>::excess_kurtosis() const {
  const double n = Dim;
  // Mean over the cell of the sum of |v|^4 = (r s)^4; s^4 = t^16 (c1 t - c2)^4 by the binomial formula.
  constexpr double kBinomial[5] = {1.0, 4.0, 6.0, 4.0, 1.0};
  double fourth = 0.0;
  for (int k = 0; k <= 4; ++k) {
    fourth += kBinomial[k] * std::pow(c1_, k) * std::pow(-c2_, 4 - k) * radial_moment(n + 3.0, 16.0 + k);
  }
  fourth *= density_ * unit_sphere_area(Dim);

  // The variance at x is the sum over lattice points of w = r^2 s^2 / n = (4/n) (1 - t) (c1 t^5 - c2 t^4)^2,
  // so its Fourier coefficients are density times the transform of w at the reciprocal lattice's points.
  const auto coefficient = [&](double f) {
    const double mixed = 2.0 * c1_ * c2_;
    return density_ * 4.0 / n *
           (c2_ * c2_ * ball_power_transform(Dim, 8, f) -
            (c2_ * c2_ + mixed) * ball_power_transform(Dim, 9, f) +
            (c1_ * c1_ + mixed) * ball_power_transform(Dim, 10, f) -
            c1_ * c1_ * ball_power_transform(Dim, 11, f));
  };
  // They fall as f^-9 or faster; at 6 cycles per unit their squares are below 1e-15 of the first.
  const int last = static_cast<int>(squared(6.0 * spacing_));
  const std::vector<double> counts = lattice_points_by_norm(Dim, last);
  double mean_squared_variance = 0.0;
  for (int m = 0; m <= last; ++m) {
    mean_squared_variance +=
        counts[static_cast<std::size_t>(m)] * squared(coefficient(std::sqrt(m) / spacing_));
  }
  const double fourth_moment = 3.0 * mean_squared_variance - 6.0 / (n * n * (n + 2.0)) * fourth;
  return fourth_moment / squared(mean_variance()) - 3.0;
}

template <int Dim>
typename Noise<Dim>::Band GradientKernel<Dim>::band() const {
  constexpr double kHighest = 4.0;  // S falls as f^-(n + 9): the rest has less than 1e-7 of the variance
  constexpr double kPanel = 0.125;  // two cycles of the spectrum's lobes, 1/2 apart, need no finer panels
  return radial_band([&](double f) { return std::pow(f, Dim - 1) * power_spectrum(f); },
                     mean_variance() / unit_sphere_area(Dim), kHighest, kPanel);
}

template class GradientKernel<1>;
template class GradientKernel<2>;
template class GradientKernel<3>;
template class GradientKernel<4>;

}  // namespace solidnoise
