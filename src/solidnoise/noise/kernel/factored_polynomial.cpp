#include "solidnoise/noise/kernel/factored_polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace solidnoise {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;

constexpr int kSextic = 6;

// Eigenvalues of the multiplication by u, in the basis of Chebyshev polynomials, modulo the polynomial
// (Good 1961); each u then becomes x = (u + 1) / 2.
Roots roots_of(std::span<const double> chebyshev) {
  const auto degree = static_cast<Eigen::Index>(chebyshev.size()) - 1;
  Eigen::MatrixXd multiplication = Eigen::MatrixXd::Zero(degree, degree);
  for (Eigen::Index k = 0; k < degree; ++k) {
    const double share = k == 0 ? 1.0 : 0.5;  // u T_0 = T_1, u T_k = (T_(k-1) + T_(k+1)) / 2
    if (k > 0) multiplication(k, k - 1) = share;
    if (k + 1 < degree) multiplication(k, k + 1) = share;
    if (k + 1 < degree) continue;
    for (Eigen::Index j = 0; j < degree; ++j) {
      multiplication(k, j) -= share * chebyshev[static_cast<std::size_t>(j)] / chebyshev.back();
    }
  }
  Roots roots;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(multiplication, false);
  for (const Complex& u : solver.eigenvalues()) roots.push_back(0.5 * (u + 1.0));
  return roots;
}

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

float factor_value(int degree, const float* a, float x) {
  const float s = x + a[0];
  if (degree == 1) return s;
  const float z = multiply_add(s, x, a[1]);
  if (degree == 2) return z;
  if (degree == 4) return multiply_add(x + a[2] + z, z, a[3]);
  const float w = multiply_add(x + a[2], z, a[3]);
  return multiply_add(w + a[4] + z, w, a[5]);
}

float product(std::span<const float> coefficients, float x) {
  const FactoredPolynomial::Shape shape(static_cast<int>(coefficients.size()));
  const float* a = coefficients.data();
  float value = 1.0f;
  const auto multiply = [&](int degree) {
    value *= factor_value(degree, a, x);
    a += degree;
  };
  for (int k = 0; k < shape.sextics; ++k) multiply(kSextic);
  if (shape.even > 0) multiply(shape.even);
  if (shape.linear > 0) multiply(shape.linear);
  return value;
}

// Where accuracy is measured: all over [0, 1].
constexpr int kProbes = 64;
float probe(int k) {
  return (static_cast<float>(k) + 0.5f) / kProbes;
}

// Sum over the probes of the squared error, times x^4 as kernels take it.
template <typename Value, typename Exact>
double squared_error(const Value& value, const Exact& exact) {
  double sum = 0.0;
  for (int k = 0; k < kProbes; ++k) {
    const float x = probe(k);
    sum += std::pow(x, 4) * std::pow(static_cast<double>(value(x)) - exact(static_cast<double>(x)), 2);
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

// The adapted coefficients of the monic factor with these roots.
std::vector<float> adapt(const Roots& roots) {
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

// Ways to make pairs of the real roots, in order: neighbours, the outermost first, or each of the lower half
// with one of the upper half.
enum class Pairing { neighbours, outermost, halves };

// Shares the roots out among the factors of a shape: pairs of them, from left to right, in turn.
std::vector<Roots> share_out(const Roots& roots, FactoredPolynomial::Shape shape, Pairing pairing) {
  Roots real;
  std::vector<Roots> pairs;
  for (const Complex& root : roots) {
    if (root.imag() == 0.0) {
      real.push_back(root);
    } else if (root.imag() > 0.0) {
      pairs.push_back({root, std::conj(root)});
    }
  }
  std::sort(real.begin(), real.end(), [](const Complex& a, const Complex& b) { return a.real() < b.real(); });
  std::vector<Roots> last;
  if (shape.linear == 1) {
    last.push_back({real.front()});
    real.erase(real.begin());
  }
  const std::size_t half = real.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    switch (pairing) {
      case Pairing::neighbours:
        pairs.push_back({real[2 * k], real[2 * k + 1]});
        break;
      case Pairing::outermost:
        pairs.push_back({real[k], real[real.size() - 1 - k]});
        break;
      case Pairing::halves:
        pairs.push_back({real[k], real[k + half]});
        break;
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Roots& a, const Roots& b) { return (a[0] + a[1]).real() < (b[0] + b[1]).real(); });

  std::vector<Roots> factors(static_cast<std::size_t>(shape.sextics + (shape.even > 0 ? 1 : 0)));
  std::size_t next = 0;
  for (const Roots& pair : pairs) {
    const auto full = [&](std::size_t k) {
      return factors[k].size() ==
             static_cast<std::size_t>(static_cast<int>(k) < shape.sextics ? kSextic : shape.even);
    };
    while (full(next)) next = (next + 1) % factors.size();
    factors[next].insert(factors[next].end(), pair.begin(), pair.end());
    next = (next + 1) % factors.size();
  }
  factors.insert(factors.end(), last.begin(), last.end());
  return factors;
}

}  // namespace

FactoredPolynomial::FactoredPolynomial(std::span<const double> chebyshev) {
  const int degree = static_cast<int>(chebyshev.size()) - 1;
  // The leading coefficient of T_n(u) is 2^(n-1), and u = 2 x - 1.
  leading_ = std::ldexp(chebyshev.back(), 2 * degree - 1);
  const Roots roots = roots_of(chebyshev);
  const auto exact = [&](double x) {
    Complex product = 1.0;
    for (const Complex& root : roots) product *= x - root;
    return product.real();
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Pairing pairing : {Pairing::halves, Pairing::outermost, Pairing::neighbours}) {
    std::vector<float> coefficients;
    for (const Roots& factor : share_out(roots, Shape(degree), pairing)) {
      const std::vector<float> adapted = adapt(factor);
      coefficients.insert(coefficients.end(), adapted.begin(), adapted.end());
    }
    const double error = squared_error([&](float x) { return product(coefficients, x); }, exact);
    if (error > least) continue;
    least = error;
    coefficients_ = coefficients;
  }
}

float FactoredPolynomial::monic(float x) const {
  return product(coefficients_, x);
}

}  // namespace solidnoise
