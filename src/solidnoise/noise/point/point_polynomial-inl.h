// Polynomials that differ from point to point, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"
#include "solidnoise/noise/point/point_cluster.h"

#if defined(SOLIDNOISE_POINT_POLYNOMIAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_POINT_POLYNOMIAL_INL
#undef SOLIDNOISE_POINT_POLYNOMIAL_INL
#else
#define SOLIDNOISE_POINT_POLYNOMIAL_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace point_sum {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = PointTag;
using V = PointVector;

// A value and its derivative.
template <class V>
struct Jet {
  V value, slope;
};

// Horner's rule, coefficient by coefficient from the highest, with the derivative where it is wanted.
template <Derivatives kDerivatives>
class HornerSum {
 public:
  HWY_INLINE HornerSum(V v, V highest) : v_(v), sum_{highest, hn::Zero(Tag())} {}

  HWY_INLINE void add(V coefficient) {
    if constexpr (kDerivatives == Derivatives::gradient) sum_.slope = hn::MulAdd(sum_.slope, v_, sum_.value);
    sum_.value = hn::MulAdd(sum_.value, v_, coefficient);
  }
  HWY_INLINE Jet<V> jet() const { return sum_; }

 private:
  V v_;
  Jet<V> sum_;
};

inline constexpr int kAnyDegree = 0;

// The polynomials of one vector of points, of a degree that is known to the compiler, or of any; of two
// impulses at once, which share the loading of the coefficients.
template <int kDegree>
struct PointHorner {
  static constexpr int kPower = kRadialTaper;  // of t that makes a kernel of it

  HWY_INLINE PointHorner(const PointPolynomials& polynomials, int lane)
      : coefficients(polynomials.coefficients + lane),
        degree(kDegree == kAnyDegree ? polynomials.degree : kDegree) {}

  template <Derivatives kDerivatives>
  HWY_INLINE void sum(V v0, V v1, Jet<V>& p0, Jet<V>& p1) const {
    const Tag d;
    const V highest = hn::Load(d, coefficients + degree * PointCluster::kSamples);
    HornerSum<kDerivatives> sum0(v0, highest), sum1(v1, highest);
    const auto add = [&](int k) HWY_ATTR {
      const V c = hn::Load(d, coefficients + k * PointCluster::kSamples);
      sum0.add(c);
      sum1.add(c);
    };
    if constexpr (kDegree == kAnyDegree) {
      for (int k = degree - 1; k >= 0; --k) add(k);
    } else {
      HWY_UNROLL(12)
      for (int k = kDegree - 1; k >= 0; --k) add(k);
    }
    p0 = sum0.jet();
    p1 = sum1.jet();
  }

  const float* coefficients;
  int degree;
};

// Clenshaw's recurrence in Chebyshev polynomials of 2 v, and its derivative by v.
template <Derivatives kDerivatives>
class ClenshawSum {
 public:
  HWY_INLINE explicit ClenshawSum(V v) : v_(v) {}

  HWY_INLINE void add(V coefficient) {
    const Tag d;
    const Jet<V> current = step(hn::Mul(hn::Set(d, 4.0f), v_), hn::Set(d, 4.0f), coefficient);
    after_ = next_;
    next_ = current;
  }
  // With the coefficient of degree 0.
  HWY_INLINE Jet<V> jet(V coefficient) const {
    return step(hn::Add(v_, v_), hn::Set(Tag(), 2.0f), coefficient);
  }

 private:
  // `times` grows by `growth` with v.
  HWY_INLINE Jet<V> step(V times, V growth, V coefficient) const {
    Jet<V> result{hn::MulAdd(times, next_.value, hn::Sub(coefficient, after_.value)), hn::Zero(Tag())};
    if constexpr (kDerivatives == Derivatives::gradient) {
      result.slope = hn::MulAdd(times, next_.slope, hn::MulSub(growth, next_.value, after_.slope));
    }
    return result;
  }

  V v_;
  Jet<V> next_{hn::Zero(Tag()), hn::Zero(Tag())};
  Jet<V> after_{hn::Zero(Tag()), hn::Zero(Tag())};
};

// The same in Chebyshev polynomials of 2 v.
struct PointClenshaw {
  static constexpr int kPower = 2;

  HWY_INLINE PointClenshaw(const PointPolynomials& polynomials, int lane)
      : coefficients(polynomials.coefficients + lane), degree(polynomials.degree) {}

  template <Derivatives kDerivatives>
  HWY_INLINE void sum(V v0, V v1, Jet<V>& p0, Jet<V>& p1) const {
    const Tag d;
    ClenshawSum<kDerivatives> sum0(v0), sum1(v1);
    for (int k = degree; k >= 1; --k) {
      const V c = hn::Load(d, coefficients + k * PointCluster::kSamples);
      sum0.add(c);
      sum1.add(c);
    }
    const V c = hn::Load(d, coefficients);
    p0 = sum0.jet(c);
    p1 = sum1.jet(c);
  }

  const float* coefficients;
  int degree;
};

}  // namespace point_sum
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POINT_POLYNOMIAL_INL
