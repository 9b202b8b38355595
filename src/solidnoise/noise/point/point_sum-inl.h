// Sums at points with kernels of their own, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <numbers>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/point/point_cluster.h"
#include "solidnoise/noise/point/point_polynomial-inl.h"

#if defined(SOLIDNOISE_POINT_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_POINT_SUM_INL
#undef SOLIDNOISE_POINT_SUM_INL
#else
#define SOLIDNOISE_POINT_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace point_sum {

// The sum at one vector of points.
template <int kDim, bool kLayer, bool kOriented, bool kFade, Derivatives kDerivatives, class Polynomial>
class PointTerms {
 public:
  static constexpr std::size_t kAtOnce = 2;

  HWY_INLINE PointTerms(const PointPolynomials& polynomials, const PointCluster& cluster,
                        const ImpulseList& impulses, int lane)
      : impulses_(impulses), polynomial_(polynomials, lane) {
    const Tag d;
    for (int axis = 0; axis < kDim; ++axis) {
      const Role role = role_of_axis<kDim>(axis);
      at_[axis] = hn::Load(d, cluster.coordinate[role] + lane);
      wave_[axis] = kOriented ? hn::Load(d, cluster.wave[role] + lane) : hn::Zero(d);
      slope_[axis] = hn::Zero(d);
    }
    for (int axis = 0; axis < 3; ++axis) {
      normal_[axis] = kLayer ? hn::Load(d, cluster.normal[axis] + lane) : hn::Zero(d);
    }
    shrink_ = hn::Load(d, cluster.inverse_square_radius + lane);
    density_ = kFade ? hn::Load(d, cluster.density + lane) : hn::Zero(d);
    flatten_ = kLayer ? hn::Load(d, cluster.inverse_square_height + lane) : hn::Zero(d);
  }

  HWY_INLINE void add(std::size_t i) {
    Term term0, term1;
    Jet<V> p0, p1;
    prepare(i, term0);
    prepare(i + 1, term1);
    polynomial_.template sum<kDerivatives>(term0.v, term1.v, p0, p1);
    sum_ = hn::MulAdd(term0.factor, p0.value, sum_);
    sum_ = hn::MulAdd(term1.factor, p1.value, sum_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      add_slopes(term0, p0);
      add_slopes(term1, p1);
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    const Tag d;
    hn::Store(sum_, d, sums.value + lane);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const V chain = hn::Mul(hn::Set(d, -2.0f), shrink_);  // d t / d offset = -2 offset / r^2
      for (int axis = 0; axis < kDim; ++axis) {
        V slope = hn::Mul(chain, slope_[axis]);
        if constexpr (kOriented) {
          const V turn = hn::Mul(hn::Set(d, 2.0f * std::numbers::pi_v<float>), wave_[axis]);
          slope = hn::NegMulAdd(turn, turning_, slope);
        }
        hn::Store(slope, d, sums.gradient[role_of_axis<kDim>(axis)] + lane);
      }
    }
  }

 private:
  // What an impulse is to the points.
  struct Term {
    V offset[kDim];
    V v;
    V factor;      // of P(v)
    V lower;       // that divided by t
    V quadrature;  // the factor with the wave's sine in place of its cosine
  };
  HWY_INLINE void prepare(std::size_t i, Term& term) const {
    const Tag d;
    V(&offset)[kDim] = term.offset;
    V& v = term.v;
    V& factor = term.factor;
    for (int axis = 0; axis < kDim; ++axis) {
      offset[axis] = hn::Sub(at_[axis], hn::Set(d, impulses_.position(role_of_axis<kDim>(axis))[i]));
    }
    V square = Dot<kDim>(offset, offset);
    factor = hn::Set(d, impulses_.attribute(kWeight)[i]);
    if constexpr (kLayer) {
      const V height = Dot<3>(offset, normal_);
      const V height_square = hn::Mul(height, height);
      square = hn::Sub(square, height_square);
      const V inside = hn::Max(hn::NegMulAdd(height_square, flatten_, hn::Set(d, 1.0f)), hn::Zero(d));
      factor = hn::Mul(factor, hn::Mul(inside, inside));
    }
    v = hn::Max(hn::NegMulAdd(square, shrink_, hn::Set(d, 0.5f)), hn::Set(d, -0.5f));
    const V t = hn::Add(v, hn::Set(d, 0.5f));
    term.lower = TimesPower<Polynomial::kPower - 1>(factor, t);
    factor = TimesPower<Polynomial::kPower>(factor, t);
    if constexpr (kFade) {
      const V share = fade(i);
      factor = hn::Mul(factor, share);
      term.lower = hn::Mul(term.lower, share);
    }
    if constexpr (kOriented) {
      V cosine, sine;
      CosineSine(d, Dot<kDim>(offset, wave_), cosine, sine);
      term.quadrature = hn::Mul(factor, sine);
      factor = hn::Mul(factor, cosine);
      term.lower = hn::Mul(term.lower, cosine);
    }
  }

  HWY_INLINE void add_slopes(const Term& term, const Jet<V>& p) {
    const V taper = hn::Set(Tag(), static_cast<float>(Polynomial::kPower));
    const V by_t = hn::MulAdd(term.factor, p.slope, hn::Mul(hn::Mul(term.lower, taper), p.value));
    for (int axis = 0; axis < kDim; ++axis) slope_[axis] = hn::MulAdd(by_t, term.offset[axis], slope_[axis]);
    if constexpr (kOriented) turning_ = hn::MulAdd(term.quadrature, p.value, turning_);
  }

  // ScaleFade of kDim dimensions.
  HWY_INLINE V fade(std::size_t i) const {
    const Tag d;
    constexpr float kLowest = 1.0f / static_cast<float>(1 << kDim);
    constexpr float kPerRise = 2.0f / kLowest;
    constexpr float kPerFall = 4.0f;
    const V y = hn::Mul(density_, hn::Set(d, impulses_.attribute(kTurn)[i]));
    const V in = hn::MulAdd(y, hn::Set(d, kPerRise), hn::Set(d, -kLowest * kPerRise));
    const V out = hn::NegMulAdd(y, hn::Set(d, kPerFall), hn::Set(d, kPerFall));
    const V x = hn::Max(hn::Min(hn::Min(in, out), hn::Set(d, 1.0f)), hn::Zero(d));
    return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(x, hn::Set(d, 2.0f), hn::Set(d, 3.0f)));
  }

  const ImpulseList& impulses_;
  Polynomial polynomial_;
  V at_[kDim];
  V wave_[kDim];
  V normal_[3];
  V shrink_;
  V density_;
  V flatten_;
  V sum_ = hn::Zero(Tag());
  V slope_[kDim];
  V turning_ = hn::Zero(Tag());
};

template <int kDim, bool kLayer, bool kOriented, bool kFade, Derivatives kDerivatives>
void SumWithPolynomial(const PointCluster& cluster, const PointPolynomials& polynomials,
                       const ImpulseList& impulses, ClusterSums& sums) {
  const auto sum = [&]<class Polynomial>() {
    using Terms = PointTerms<kDim, kLayer, kOriented, kFade, kDerivatives, Polynomial>;
    SumTerms<Terms>(polynomials, cluster, impulses, sums);
  };
  if (!polynomials.power) return sum.template operator()<PointClenshaw>();
  // Half of the code would be for gradients, which few want: in a loop they take as long.
  if constexpr (kDerivatives != Derivatives::none) return sum.template operator()<PointHorner<kAnyDegree>>();
  if (polynomials.degree <= 4) return sum.template operator()<PointHorner<4>>();
  if (polynomials.degree <= 8) return sum.template operator()<PointHorner<8>>();
  sum.template operator()<PointHorner<12>>();
}

template <int kDim, bool kLayer>
void SumOfDimension(const PointKernel& kernel, const PointCluster& cluster,
                    const PointPolynomials& polynomials, const ImpulseList& impulses, ClusterSums& sums) {
  const auto sum = [&]<bool kOriented, bool kFade>() {
    if (cluster.derivatives != Derivatives::none) {
      SumWithPolynomial<kDim, kLayer, kOriented, kFade, Derivatives::gradient>(cluster, polynomials, impulses,
                                                                               sums);
    } else {
      SumWithPolynomial<kDim, kLayer, kOriented, kFade, Derivatives::none>(cluster, polynomials, impulses,
                                                                           sums);
    }
  };
  if (kernel.oriented) {
    kernel.fade ? sum.template operator()<true, true>() : sum.template operator()<true, false>();
  } else {
    kernel.fade ? sum.template operator()<false, true>() : sum.template operator()<false, false>();
  }
}

}  // namespace point_sum

inline void SumPointImpulses(const PointKernel& kernel, const PointCluster& cluster,
                             const PointPolynomials& polynomials, const ImpulseList& impulses,
                             ClusterSums& sums) {
  if (kernel.layer) return point_sum::SumOfDimension<3, true>(kernel, cluster, polynomials, impulses, sums);
  if (kernel.dimensions == 3) {
    return point_sum::SumOfDimension<3, false>(kernel, cluster, polynomials, impulses, sums);
  }
  point_sum::SumOfDimension<4, false>(kernel, cluster, polynomials, impulses, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POINT_SUM_INL
