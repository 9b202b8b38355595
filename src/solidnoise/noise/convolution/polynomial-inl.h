// Polynomials in single precision, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <vector>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"

#if defined(SOLIDNOISE_POLYNOMIAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_POLYNOMIAL_INL
#undef SOLIDNOISE_POLYNOMIAL_INL
#else
#define SOLIDNOISE_POLYNOMIAL_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A polynomial in powers of v, of a degree known to the compiler, by Horner's rule. Its coefficients stay in
// registers.
template <int kDegree>
struct Horner {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D d, const std::vector<float>& coefficients) {
      for (int k = 0; k <= kDegree; ++k)
        coefficients_[k] = hn::Set(d, coefficients[static_cast<std::size_t>(k)]);
    }

    HWY_INLINE V operator()(D, V v) const {
      V sum = coefficients_[kDegree];
      HWY_UNROLL(16)
      for (int k = kDegree - 1; k >= 0; --k) sum = hn::MulAdd(sum, v, coefficients_[k]);
      return sum;
    }

   private:
    V coefficients_[kDegree + 1];
  };
};

// A sum of Chebyshev polynomials of u = 2 v, by Clenshaw's recurrence: stable for any degree.
struct Clenshaw {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D, const std::vector<float>& coefficients)
        : coefficients_(coefficients.data()), degree_(static_cast<int>(coefficients.size()) - 1) {}

    HWY_INLINE V operator()(D d, V v) const {
      const V u = hn::Add(v, v);
      const V twice_u = hn::Add(u, u);
      V next = hn::Zero(d);
      V after_next = hn::Zero(d);
      for (int k = degree_; k >= 1; --k) {
        const V current = hn::MulAdd(twice_u, next, hn::Sub(hn::Set(d, coefficients_[k]), after_next));
        after_next = next;
        next = current;
      }
      return hn::MulAdd(u, next, hn::Sub(hn::Set(d, coefficients_[0]), after_next));
    }

   private:
    const float* coefficients_;
    int degree_;
  };
};

// The polynomial of a compact kernel and its derivative.
template <class D, class Polynomial>
struct BoundKernel {
  using Bound = typename Polynomial::template Bound<D>;

  HWY_INLINE BoundKernel(D d, const RadialPolynomial& kernel)
      : value(d, kernel.value), derivative(d, kernel.derivative) {}

  Bound value;
  Bound derivative;
};

// Calls the evaluator compiled for the kernel's polynomial: Horner's rule for the even degrees up to 12
// (coefficient lists are padded to those), Clenshaw's recurrence otherwise.
template <class Call>
HWY_INLINE void WithPolynomial(const RadialPolynomial& kernel, Call&& call) {
  if (kernel.basis == RadialPolynomial::Basis::chebyshev) return call(Clenshaw());
  switch (kernel.value.size()) {
    case 3:
      return call(Horner<2>());
    case 5:
      return call(Horner<4>());
    case 7:
      return call(Horner<6>());
    case 9:
      return call(Horner<8>());
    case 11:
      return call(Horner<10>());
    default:
      return call(Horner<12>());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POLYNOMIAL_INL
