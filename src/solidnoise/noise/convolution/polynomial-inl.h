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

// A value and its derivative.
template <class V>
struct Jet {
  V value, slope;
};

// A polynomial in powers of v = t - 1/2, of a degree known to the compiler: its coefficients stay in
// registers. Whether slopes are used or not, values are the same.
template <int kDegree>
struct Horner {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;
    // The power of t that makes a kernel of it.
    static constexpr int power(int taper) { return taper; }

    HWY_INLINE Bound(D d, const RadialPolynomial& polynomial) {
      for (int k = 0; k <= kDegree; ++k) {
        coefficients_[k] = hn::Set(d, polynomial.value[static_cast<std::size_t>(k)]);
      }
    }

    HWY_INLINE V value(D d, V t) const { return jet(d, t).value; }

    HWY_INLINE Jet<V> jet(D d, V t) const {
      const V v = hn::Sub(t, hn::Set(d, 0.5f));
      Jet<V> sum{hn::MulAdd(coefficients_[kDegree], v, coefficients_[kDegree - 1]), coefficients_[kDegree]};
      for (int k = kDegree - 2; k >= 0; --k) {
        sum.slope = hn::MulAdd(sum.slope, v, sum.value);
        sum.value = hn::MulAdd(sum.value, v, coefficients_[k]);
      }
      return sum;
    }

   private:
    V coefficients_[kDegree + 1];
  };
};

// A sum of Chebyshev polynomials of 2 v, by Clenshaw's recurrence: stable for any degree.
struct Clenshaw {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;
    static constexpr int power(int) { return 2; }

    HWY_INLINE Bound(D, const RadialPolynomial& polynomial) : polynomial_(polynomial) {}

    HWY_INLINE V value(D d, V t) const { return sum(d, t, polynomial_.value); }

    HWY_INLINE Jet<V> jet(D d, V t) const { return {value(d, t), sum(d, t, polynomial_.derivative)}; }

   private:
    static HWY_INLINE V sum(D d, V t, const std::vector<float>& coefficients) {
      const V v = hn::Sub(t, hn::Set(d, 0.5f));
      const V u = hn::Add(v, v);
      const V twice_u = hn::Add(u, u);
      V next = hn::Zero(d);
      V after_next = hn::Zero(d);
      for (std::size_t k = coefficients.size() - 1; k >= 1; --k) {
        const V current = hn::MulAdd(twice_u, next, hn::Sub(hn::Set(d, coefficients[k]), after_next));
        after_next = next;
        next = current;
      }
      return hn::MulAdd(u, next, hn::Sub(hn::Set(d, coefficients[0]), after_next));
    }

    const RadialPolynomial& polynomial_;
  };
};

// w t^k and w t^(k - 1).
template <int kPower, class V>
struct Taper {
  HWY_INLINE Taper(V weight, V t) : lower(weight) {
    if constexpr (kPower == 4) {
      const V square = hn::Mul(t, t);
      const V weighted = hn::Mul(weight, square);
      lower = hn::Mul(weighted, t);
      value = hn::Mul(weighted, square);
    } else {
      for (int k = 1; k < kPower; ++k) lower = hn::Mul(lower, t);
      value = hn::Mul(lower, t);
    }
  }
  V lower, value;
};

// The kernel w t^k P(v) and, where wanted, its derivative by t, of one vector of samples and one impulse.
template <int kTaper, Derivatives kDerivatives, class D, class Polynomial, class V = hn::Vec<D>>
class RadialTerm {
  static constexpr int kPower = Polynomial::power(kTaper);

 public:
  HWY_INLINE RadialTerm(D d, const Polynomial& polynomial, V t, V weight) : taper_(weight, t) {
    if constexpr (kDerivatives == Derivatives::none) {
      factor_ = {polynomial.value(d, t), hn::Zero(d)};
    } else {
      factor_ = polynomial.jet(d, t);
    }
  }

  HWY_INLINE V value() const { return hn::Mul(taper_.value, factor_.value); }
  HWY_INLINE V add_to(V sum) const { return hn::MulAdd(taper_.value, factor_.value, sum); }

  HWY_INLINE V derivative() const {
    const V power = hn::Set(D(), static_cast<float>(kPower));
    return hn::MulAdd(taper_.value, factor_.slope, hn::Mul(hn::Mul(taper_.lower, power), factor_.value));
  }

 private:
  Taper<kPower, V> taper_;
  Jet<V> factor_;
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
