#include "solidnoise/noise/kernel/adapted_factor.h"

#include <array>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace solidnoise {
namespace {

// Coefficients of the monic polynomial with these roots, conjugate where they are not real; low to high.
std::vector<double> polynomial_of(const Roots& roots) {
  std::vector<Complex> product{1.0};
  for (const Complex& root : roots) {
    product.insert(product.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < product.size(); ++k) product[k] -= root * product[k + 1];
  }
  std::vector<double> coefficients;
  for (const Complex& c : product) coefficients.push_back(c.real());
  return coefficients;
}

double value_of(const std::vector<double>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t k = coefficients.size(); k > 0; --k) value = value * x + coefficients[k - 1];
  return value;
}

// The real roots of a cubic polynomial, low to high coefficients.
std::vector<double> real_cubic_roots(const std::array<double, 4>& cubic) {
  Eigen::Matrix3d companion = Eigen::Matrix3d::Zero();
  companion(1, 0) = companion(2, 1) = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) companion(k, 2) = -cubic[static_cast<std::size_t>(k)] / cubic[3];
  const auto polynomial = [&](double x) { return ((cubic[3] * x + cubic[2]) * x + cubic[1]) * x + cubic[0]; };
  const auto slope = [&](double x) { return (3.0 * cubic[3] * x + 2.0 * cubic[2]) * x + cubic[1]; };
  std::vector<double> roots;
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(companion, false);
  for (const Complex& root : solver.eigenvalues()) {
    if (std::abs(root.imag()) > 1e-6 * (1.0 + std::abs(root))) continue;
    double x = root.real();
    for (int step = 0; step < 2 && slope(x) != 0.0; ++step) x -= polynomial(x) / slope(x);
    roots.push_back(x);
  }
  return roots;
}

// The adapted coefficients of u = x^6 + u5 x^5 + .. + u0; one to three solutions. With w = x^3 + p2 x^2 + p1
// x + p0, comparing (w + z + a4) w + a5 with u power by power leaves all as polynomials of a0, and at x^1 a
// cubic equation for it.
std::vector<std::array<double, kSextic>> adapt_sextic(const std::vector<double>& u) {
  struct Given {
    double p1, p0, a1, a2, a4, rest;
  };
  const double p2 = 0.5 * (u[5] - 1.0);
  const auto given = [&](double a0) {
    Given g;
    g.a2 = p2 - a0;
    g.p1 = 0.5 * (u[4] - p2 * p2 - p2 - a0);
    g.a1 = g.p1 - a0 * g.a2;
    const double cube = u[3] - (2.0 * g.p1 * p2 + g.p1 + a0 * p2 + g.a1);
    g.p0 = u[2] - g.p1 * g.p1 - a0 * g.p1 - g.a1 * p2 - p2 * cube;
    g.a4 = cube - 2.0 * g.p0;
    g.rest = (2.0 * g.p1 + a0) * g.p0 + g.a1 * g.p1 + g.a4 * g.p1 - u[1];
    return g;
  };
  // The cubic through the rests at -1, 0, 1 and 2.
  const double r0 = given(-1.0).rest;
  const double r1 = given(0.0).rest;
  const double r2 = given(1.0).rest;
  const double r3 = given(2.0).rest;
  const double c3 = (r3 - 3.0 * r2 + 3.0 * r1 - r0) / 6.0;
  const double c2 = 0.5 * (r0 + r2) - r1;
  const double c1 = 0.5 * (r2 - r0) - c3;
  std::vector<std::array<double, kSextic>> solutions;
  for (const double a0 : real_cubic_roots({r1, c1, c2, c3})) {
    const Given g = given(a0);
    const double a5 = u[0] - (g.p0 + g.a1 + g.a4) * g.p0;
    // w = (x + a2) z + a3 has p0 = a1 a2 + a3; z is a1 at 0.
    solutions.push_back({a0, g.a1, g.a2, g.p0 - g.a1 * g.a2, g.a4, a5});
  }
  return solutions;
}

std::array<double, 4> adapt_quartic(const std::vector<double>& u) {
  const double a0 = 0.5 * (u[3] - 1.0);
  const double sum = u[2] - a0 * a0 - a0;  // 2 a1 + a2
  const double a1 = u[1] - a0 * sum;
  const double a2 = sum - 2.0 * a1;
  return {a0, a1, a2, u[0] - a1 * (a1 + a2)};
}

float multiply_add(float a, float b, float c) {
  return static_cast<float>(static_cast<double>(a) * static_cast<double>(b) + static_cast<double>(c));
}

}  // namespace

float factor_value(int degree, const float* a, float x) {
  const float s = x + a[0];
  if (degree == 1) return s;
  const float z = multiply_add(s, x, a[1]);
  if (degree == 2) return z;
  if (degree == 4) return multiply_add(x + a[2] + z, z, a[3]);
  const float w = multiply_add(x + a[2], z, a[3]);
  return multiply_add(w + a[4] + z, w, a[5]);
}

std::vector<float> adapted_coefficients(const Roots& roots) {
  const std::vector<double> u = polynomial_of(roots);
  const auto single = [](const auto& a) { return std::vector<float>(a.begin(), a.end()); };
  switch (roots.size()) {
    case 1:
      return single(std::array{u[0]});
    case 2:
      return single(std::array{u[1], u[0]});
    case 4:
      return single(adapt_quartic(u));
    default:
      break;
  }
  std::vector<float> best(kSextic, std::numeric_limits<float>::quiet_NaN());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& solution : adapt_sextic(u)) {
    const std::vector<float> a = single(solution);
    const double error = squared_error([&](float x) { return factor_value(kSextic, a.data(), x); },
                                       [&](double x) { return value_of(u, x); });
    if (error > least) continue;
    least = error;
    best = a;
  }
  return best;
}

}  // namespace solidnoise
