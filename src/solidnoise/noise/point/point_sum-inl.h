// Sums at points with kernels of their own, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/point/point_cluster.h"
#include "solidnoise/noise/point/scale_transition.h"

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
namespace hn = hwy::HWY_NAMESPACE;

using Tag = PointTag;
using V = PointVector;

// The polynomials of one vector of points, by Horner's rule; of two impulses at once, which share the loading
// of the coefficients.
template <int kDegree>
struct PointHorner {
  static constexpr int kTaper = 3;  // the power of t that makes a kernel of it

  HWY_INLINE PointHorner(const PointPolynomials& polynomials, int lane)
      : coefficients(polynomials.coefficients + lane) {}

  HWY_INLINE void operator()(V v0, V v1, V& p0, V& p1) const {
    const Tag d;
    p0 = p1 = hn::Load(d, coefficients + kDegree * PointCluster::kSamples);
    HWY_UNROLL(12)
    for (int k = kDegree - 1; k >= 0; --k) {
      const V c = hn::Load(d, coefficients + k * PointCluster::kSamples);
      p0 = hn::MulAdd(p0, v0, c);
      p1 = hn::MulAdd(p1, v1, c);
    }
  }

  const float* coefficients;
};

// The same in Chebyshev polynomials of 2 v, by Clenshaw's recurrence.
struct PointClenshaw {
  static constexpr int kTaper = 2;

  HWY_INLINE PointClenshaw(const PointPolynomials& polynomials, int lane)
      : coefficients(polynomials.coefficients + lane), degree(polynomials.degree) {}

  HWY_INLINE void operator()(V v0, V v1, V& p0, V& p1) const {
    const Tag d;
    const V four = hn::Set(d, 4.0f);
    V next0 = hn::Zero(d), after0 = hn::Zero(d);
    V next1 = hn::Zero(d), after1 = hn::Zero(d);
    for (int k = degree; k >= 1; --k) {
      const V c = hn::Load(d, coefficients + k * PointCluster::kSamples);
      const V current0 = hn::MulAdd(hn::Mul(four, v0), next0, hn::Sub(c, after0));
      const V current1 = hn::MulAdd(hn::Mul(four, v1), next1, hn::Sub(c, after1));
      after0 = next0;
      after1 = next1;
      next0 = current0;
      next1 = current1;
    }
    const V c = hn::Load(d, coefficients);
    p0 = hn::MulAdd(hn::Add(v0, v0), next0, hn::Sub(c, after0));
    p1 = hn::MulAdd(hn::Add(v1, v1), next1, hn::Sub(c, after1));
  }

  const float* coefficients;
  int degree;
};

// The sum at one vector of points.
template <int kDim, bool kLayer, bool kOriented, bool kFade, class Polynomial>
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
    }
    for (int axis = 0; axis < 3; ++axis) {
      normal_[axis] = kLayer ? hn::Load(d, cluster.normal[axis] + lane) : hn::Zero(d);
    }
    shrink_ = hn::Load(d, cluster.inverse_square_radius + lane);
    density_ = kFade ? hn::Load(d, cluster.density + lane) : hn::Zero(d);
    flatten_ = kLayer ? hn::Load(d, cluster.inverse_square_height + lane) : hn::Zero(d);
  }

  HWY_INLINE void add(std::size_t i) {
    V v0, v1, factor0, factor1, p0, p1;
    term(i, v0, factor0);
    term(i + 1, v1, factor1);
    polynomial_(v0, v1, p0, p1);
    sum_ = hn::MulAdd(factor0, p0, sum_);
    sum_ = hn::MulAdd(factor1, p1, sum_);
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const { hn::Store(sum_, Tag(), sums.value + lane); }

 private:
  // What an impulse is to the points: v, and the factor of P(v).
  HWY_INLINE void term(std::size_t i, V& v, V& factor) const {
    const Tag d;
    V offset[kDim];
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
    for (int k = 0; k < Polynomial::kTaper; ++k) factor = hn::Mul(factor, t);
    if constexpr (kFade) factor = hn::Mul(factor, fade(i));
    if constexpr (kOriented) {
      V cosine, sine;
      CosineSine(d, Dot<kDim>(offset, wave_), cosine, sine);
      factor = hn::Mul(factor, cosine);
    }
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
};

template <int kDim, bool kLayer, bool kOriented, bool kFade>
void SumWithPolynomial(const PointCluster& cluster, const PointPolynomials& polynomials,
                       const ImpulseList& impulses, ClusterSums& sums) {
  if (!polynomials.power) {
    return SumTerms<PointTerms<kDim, kLayer, kOriented, kFade, PointClenshaw>>(polynomials, cluster, impulses,
                                                                               sums);
  }
  if (polynomials.degree <= 4) {
    return SumTerms<PointTerms<kDim, kLayer, kOriented, kFade, PointHorner<4>>>(polynomials, cluster,
                                                                                impulses, sums);
  }
  if (polynomials.degree <= 8) {
    return SumTerms<PointTerms<kDim, kLayer, kOriented, kFade, PointHorner<8>>>(polynomials, cluster,
                                                                                impulses, sums);
  }
  return SumTerms<PointTerms<kDim, kLayer, kOriented, kFade, PointHorner<12>>>(polynomials, cluster, impulses,
                                                                               sums);
}

template <int kDim, bool kLayer>
void SumOfDimension(const PointKernel& kernel, const PointCluster& cluster,
                    const PointPolynomials& polynomials, const ImpulseList& impulses, ClusterSums& sums) {
  if (kernel.oriented) {
    kernel.fade ? SumWithPolynomial<kDim, kLayer, true, true>(cluster, polynomials, impulses, sums)
                : SumWithPolynomial<kDim, kLayer, true, false>(cluster, polynomials, impulses, sums);
  } else {
    kernel.fade ? SumWithPolynomial<kDim, kLayer, false, true>(cluster, polynomials, impulses, sums)
                : SumWithPolynomial<kDim, kLayer, false, false>(cluster, polynomials, impulses, sums);
  }
}

}  // namespace point_sum

inline void SumPointImpulses(const PointKernel& kernel, const PointCluster& cluster,
                             const PointPolynomials& polynomials, const ImpulseList& impulses,
                             ClusterSums& sums) {
  if (kernel.layer) return point_sum::SumOfDimension<3, true>(kernel, cluster, polynomials, impulses, sums);
  switch (kernel.dimensions) {
    case 2:
      return point_sum::SumOfDimension<2, false>(kernel, cluster, polynomials, impulses, sums);
    case 3:
      return point_sum::SumOfDimension<3, false>(kernel, cluster, polynomials, impulses, sums);
    default:
      return point_sum::SumOfDimension<4, false>(kernel, cluster, polynomials, impulses, sums);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POINT_SUM_INL
