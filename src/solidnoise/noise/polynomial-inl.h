// Polynomials in single precision, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <hwy/highway.h>

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

// Horner's rule for a polynomial in powers of v, of a degree known to the compiler.
template <int kDegree>
struct Horner {
  explicit Horner(int) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V operator()(D d, V v, const float* coefficients) const {
    V sum = hn::Set(d, coefficients[kDegree]);
    HWY_UNROLL(16)
    for (int k = kDegree - 1; k >= 0; --k) sum = hn::MulAdd(sum, v, hn::Set(d, coefficients[k]));
    return sum;
  }
};

// Clenshaw's recurrence for a sum of Chebyshev polynomials of u = 2 v: stable for any degree.
struct Clenshaw {
  explicit Clenshaw(int degree) : degree_(degree) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V operator()(D d, V v, const float* coefficients) const {
    const V u = hn::Add(v, v);
    const V twice_u = hn::Add(u, u);
    V next = hn::Zero(d);
    V after_next = hn::Zero(d);
    for (int k = degree_; k >= 1; --k) {
      const V current = hn::MulAdd(twice_u, next, hn::Sub(hn::Set(d, coefficients[k]), after_next));
      after_next = next;
      next = current;
    }
    return hn::MulAdd(u, next, hn::Sub(hn::Set(d, coefficients[0]), after_next));
  }

 private:
  int degree_;
};

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POLYNOMIAL_INL
