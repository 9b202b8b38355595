// Polynomials in single precision, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <cstddef>
#include <vector>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/kernel/factored_polynomial.h"

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

// A product of factors (see FactoredPolynomial), of a degree known to the compiler: its coefficients stay in
// registers. Whether slopes are used or not, values are the same.
template <int kDegree>
struct Factored {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D d, const RadialPolynomial& polynomial) {
      leading = hn::Set(d, polynomial.leading);
      for (int k = 0; k < kDegree; ++k) a_[k] = hn::Set(d, polynomial.value[static_cast<std::size_t>(k)]);
    }

    HWY_INLINE V value(D d, V x) const { return jet(d, x).value; }

    HWY_INLINE Jet<V> jet(D d, V x) const {
      constexpr FactoredPolynomial::Shape kShape(kDegree);
      Jet<V> product;
      bool first = true;
      const auto multiply = [&](const Jet<V>& factor) HWY_ATTR {
        if (!first) {
          product.slope = hn::MulAdd(product.value, factor.slope, hn::Mul(product.slope, factor.value));
          product.value = hn::Mul(product.value, factor.value);
        } else {
          product = factor;
        }
        first = false;
      };
      if constexpr (kShape.sextics > 0) multiply(sextic(d, x, a_));
      if constexpr (kShape.sextics > 1) multiply(sextic(d, x, a_ + 6));
      static_assert(kShape.sextics <= 2);
      const V* const rest = a_ + 6 * kShape.sextics;
      if constexpr (kShape.even == 4) multiply(quartic(d, x, rest));
      if constexpr (kShape.even == 2) multiply(quadratic(x, rest));
      if constexpr (kShape.linear == 1) multiply({hn::Add(x, rest[kShape.even]), hn::Set(d, 1.0f)});
      return product;
    }

    V leading;

   private:
    static HWY_INLINE Jet<V> quadratic(V x, const V* a) {
      const V s = hn::Add(x, a[0]);
      return {hn::MulAdd(s, x, a[1]), hn::Add(s, x)};
    }

    static HWY_INLINE Jet<V> quartic(D d, V x, const V* a) {
      const Jet<V> z = quadratic(x, a);
      const V y = hn::Add(hn::Add(x, a[2]), z.value);
      const V y_slope = hn::Add(z.slope, hn::Set(d, 1.0f));
      return {hn::MulAdd(y, z.value, a[3]), hn::MulAdd(y, z.slope, hn::Mul(y_slope, z.value))};
    }

    static HWY_INLINE Jet<V> sextic(D, V x, const V* a) {
      const Jet<V> z = quadratic(x, a);
      const V l = hn::Add(x, a[2]);
      const Jet<V> w{hn::MulAdd(l, z.value, a[3]), hn::MulAdd(l, z.slope, z.value)};
      const V y = hn::Add(hn::Add(w.value, a[4]), z.value);
      const V y_slope = hn::Add(w.slope, z.slope);
      return {hn::MulAdd(y, w.value, a[5]), hn::MulAdd(y, w.slope, hn::Mul(y_slope, w.value))};
    }

    V a_[kDegree];
  };
};

// A sum of Chebyshev polynomials of u = 2 x - 1, by Clenshaw's recurrence: stable for any degree.
struct Clenshaw {
  template <class D>
  class Bound {
   public:
    using V = hn::Vec<D>;

    HWY_INLINE Bound(D d, const RadialPolynomial& polynomial)
        : leading(hn::Set(d, polynomial.leading)), polynomial_(polynomial) {}

    HWY_INLINE V value(D d, V x) const { return sum(d, x, polynomial_.value); }

    HWY_INLINE Jet<V> jet(D d, V x) const { return {value(d, x), sum(d, x, polynomial_.derivative)}; }

    V leading;

   private:
    static HWY_INLINE V sum(D d, V x, const std::vector<float>& coefficients) {
      const V v = hn::Sub(x, hn::Set(d, 0.5f));
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

// w t^2 P(t) and, where wanted, its derivative by t, of one vector of samples and one impulse; but for the
// leading coefficient of P.
template <Derivatives kDerivatives, class D, class Polynomial, class V = hn::Vec<D>>
struct RadialTerm {
  HWY_INLINE RadialTerm(D d, const Polynomial& polynomial, V t, V weight)
      : weighted_t(hn::Mul(t, weight)), weighted_t2(hn::Mul(weighted_t, t)) {
    if constexpr (kDerivatives == Derivatives::none) {
      factor = {polynomial.value(d, t), hn::Zero(d)};
    } else {
      factor = polynomial.jet(d, t);
    }
  }

  HWY_INLINE V value() const { return hn::Mul(weighted_t2, factor.value); }
  HWY_INLINE V add_to(V sum) const { return hn::MulAdd(weighted_t2, factor.value, sum); }

  HWY_INLINE V derivative() const {
    return hn::MulAdd(weighted_t2, factor.slope, hn::Mul(hn::Add(weighted_t, weighted_t), factor.value));
  }

  V weighted_t;
  V weighted_t2;
  Jet<V> factor;
};

// Calls the evaluator compiled for the polynomial, which is of at most that degree if it is factored.
template <int kHighestDegree, class Call>
HWY_INLINE void WithPolynomial(const RadialPolynomial& polynomial, Call&& call) {
  if (polynomial.form == RadialPolynomial::Form::chebyshev) return call(Clenshaw());
  const auto with_degree = [&]<int kDegree>(const auto& self) {
    if constexpr (kDegree < kHighestDegree) {
      if (polynomial.value.size() > kDegree) return self.template operator()<kDegree + 1>(self);
    }
    call(Factored<kDegree>());
  };
  with_degree.template operator()<1>(with_degree);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POLYNOMIAL_INL
