#include "solidnoise/noise/kernel/factored_polynomial.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "solidnoise/noise/kernel/adapted_factor.h"

namespace solidnoise {
namespace {

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
      const std::vector<float> adapted = adapted_coefficients(factor);
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
