#pragma once

#include <span>
#include <vector>

namespace solidnoise {

// A polynomial as a product of monic factors whose coefficients are adapted (Knuth, The Art of Computer
// Programming 2, 4.6.4), so that a value takes about half of the multiplications of Horner's rule:
//   degree 6   z = (x + a0) x + a1,  w = (x + a2) z + a3,  factor = (w + a4 + z) w + a5
//   degree 4   z = (x + a0) x + a1,  factor = (x + a2 + z) z + a3
//   degree 2   (x + a0) x + a1
//   degree 1   x + a0
// As many as there can be are of degree 6; one of 4 or 2, and one of 1, make up the rest. The processors that
// we know add beside their multipliers, so that this takes the time of half of the operations, though there
// are as many of them.
class FactoredPolynomial {
 public:
  // Degrees of the factors of a polynomial, in the order of their coefficients: of degree 6, then 4 or 2,
  // then 1.
  struct Shape {
    constexpr explicit Shape(int degree)
        : sextics(degree / 6), even(degree % 6 / 2 * 2), linear(degree % 2) {}

    int sextics;  // how many
    int even;     // degree of the one of degree 4 or 2; 0 for none
    int linear;   // 1 or 0
  };

  // `chebyshev` are coefficients in Chebyshev polynomials of 2 x - 1, from degree 0, the last not 0; at least
  // two. Of the ways to share the roots out among the factors some are tried, and the one is kept that in
  // single precision is the most accurate on [0, 1].
  explicit FactoredPolynomial(std::span<const double> chebyshev);

  int degree() const { return static_cast<int>(coefficients_.size()); }
  double leading() const { return leading_; }  // coefficient, of x^degree: a factor of all
  // Of one factor after the other, as many as its degree.
  std::span<const float> coefficients() const { return coefficients_; }

  // The product of the factors at x, in single precision, rounded as multiply-adds are.
  float monic(float x) const;

 private:
  double leading_;
  std::vector<float> coefficients_;
};

}  // namespace solidnoise
