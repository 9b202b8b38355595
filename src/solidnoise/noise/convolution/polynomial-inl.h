// Polynomials in single precision, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <cstddef>
#include <vector>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/kernel/compact_kernel.h"

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

// max(x, 0), x not NaN. Integers are in the order of the floats that they are the bits of, or negative where
// these are; and they are compared beside the multipliers, which some processors compare floats with.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V PositivePart(D d, V x) {
  const hn::RebindToSigned<D> di;
  return hn::BitCast(d, hn::Max(hn::BitCast(di, x), hn::Zero(di)));
}

// A polynomial in powers of v = t - 1/2, of a degree known to the compiler: its coefficients stay in
// registers.
template <int kDegree>
struct Horner {
  // Of t that makes a kernel of it.
  static constexpr int power(int taper) { return taper; }

  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D d, const std::vector<float>& coefficients) {
      for (std::size_t k = 0; k <= kDegree; ++k) coefficients_[k] = hn::Set(d, coefficients[k]);
    }

    HWY_INLINE V value(D d, V t) const {
      const V v = hn::Sub(t, hn::Set(d, 0.5f));
      V sum = hn::MulAdd(coefficients_[kDegree], v, coefficients_[kDegree - 1]);
      for (int k = kDegree - 2; k >= 0; --k) sum = hn::MulAdd(sum, v, coefficients_[k]);
      return sum;
    }

   private:
    V coefficients_[kDegree + 1];
  };
};

// A sum of Chebyshev polynomials of 2 v, by Clenshaw's recurrence: stable for any degree.
struct Clenshaw {
  static constexpr int power(int) { return 2; }

  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D, const std::vector<float>& coefficients) : coefficients_(coefficients) {}

    HWY_INLINE V value(D d, V t) const {
      const V v = hn::Sub(t, hn::Set(d, 0.5f));
      const V u = hn::Add(v, v);
      const V twice_u = hn::Add(u, u);
      V next = hn::Zero(d);
      V after_next = hn::Zero(d);
      for (std::size_t k = coefficients_.size() - 1; k >= 1; --k) {
        const V current = hn::MulAdd(twice_u, next, hn::Sub(hn::Set(d, coefficients_[k]), after_next));
        after_next = next;
        next = current;
      }
      return hn::MulAdd(u, next, hn::Sub(hn::Set(d, coefficients_[0]), after_next));
    }

   private:
    const std::vector<float>& coefficients_;
  };
};

// w t^k
template <int kPower, class V>
HWY_INLINE V TimesPower(V weight, V t) {
  if constexpr (kPower == 4) {
    const V square = hn::Mul(t, t);
    return hn::Mul(hn::Mul(weight, square), square);
  }
  for (int k = 0; k < kPower; ++k) weight = hn::Mul(weight, t);
  return weight;
}

// w t^k P(v), for vectors of samples.
template <int kPower, class Polynomial, class D>
class TaperedPolynomial {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE TaperedPolynomial(D d, const std::vector<float>& coefficients) : polynomial_(d, coefficients) {}

  HWY_INLINE V of(D d, V t, V weight) const {
    return hn::Mul(TimesPower<kPower>(weight, t), polynomial_.value(d, t));
  }
  HWY_INLINE V add_to(V sum, D d, V t, V weight) const {
    return hn::MulAdd(TimesPower<kPower>(weight, t), polynomial_.value(d, t), sum);
  }

 private:
  typename Polynomial::template Bound<D> polynomial_;
};

// A kernel and its derivative by t: w t^k P(v) and w t^(k - 1) Q(v).
template <int kTaper, class Polynomial, class D>
struct RadialKernel {
  static constexpr int kPower = Polynomial::power(kTaper);

  HWY_INLINE RadialKernel(D d, const RadialPolynomial& polynomial)
      : value(d, polynomial.value), slope(d, polynomial.slope) {}

  TaperedPolynomial<kPower, Polynomial, D> value;
  TaperedPolynomial<kPower - 1, Polynomial, D> slope;
};

// Calls the evaluator compiled for the polynomial, whose degree in powers is even and at most that.
template <int kHighestDegree, class Call>
HWY_INLINE void WithPolynomial(const RadialPolynomial& polynomial, Call&& call) {
  if (!polynomial.power) return call(Clenshaw());
  const auto with_degree = [&]<int kDegree>(const auto& self) {
    if constexpr (kDegree < kHighestDegree) {
      if (polynomial.value.size() > kDegree + 1) return self.template operator()<kDegree + 2>(self);
    }
    call(Horner<kDegree>());
  };
  with_degree.template operator()<2>(with_degree);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POLYNOMIAL_INL
