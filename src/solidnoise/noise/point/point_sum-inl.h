// Sums at points with kernels of their own, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <algorithm>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/convolution/impulse_cull-inl.h"
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

using Tag = hn::CappedTag<float, PointCluster::kSamples>;
using V = hn::Vec<Tag>;

// The polynomials of one vector of points, by Horner's rule; of two impulses at once, which share the loading
// of the coefficients.
template <int kDegree>
struct PointHorner {
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

// What an impulse is to one vector of points: v, and the factor of P(v).
template <int kDim, bool kLayer, bool kOriented, bool kFade>
class PointTerms {
 public:
  HWY_INLINE PointTerms(const PointCluster& cluster, const PointImpulses& impulses, int lane)
      : impulses_(impulses) {
    const Tag d;
    for (int axis = 0; axis < kDim; ++axis) {
      at_[axis] = hn::Load(d, cluster.coordinate[axis] + lane);
      wave_[axis] = kOriented ? hn::Load(d, cluster.wave[axis] + lane) : hn::Zero(d);
    }
    for (int axis = 0; axis < 3; ++axis) {
      normal_[axis] = kLayer ? hn::Load(d, cluster.normal[axis] + lane) : hn::Zero(d);
    }
    shrink_ = hn::Load(d, cluster.inverse_square_radius + lane);
    density_ = kFade ? hn::Load(d, cluster.density + lane) : hn::Zero(d);
    flatten_ = kLayer ? hn::Load(d, cluster.inverse_square_height + lane) : hn::Zero(d);
  }

  HWY_INLINE void term(std::size_t i, V& v, V& factor) const {
    const Tag d;
    V offset[kDim];
    for (int axis = 0; axis < kDim; ++axis) {
      offset[axis] = hn::Sub(at_[axis], hn::Set(d, impulses_.position(axis)[i]));
    }
    V square = dot<kDim>(offset, offset);
    factor = hn::Set(d, impulses_.attribute(PointImpulses::kWeight)[i]);
    if constexpr (kLayer) {
      const V height = dot<3>(offset, normal_);
      const V height_square = hn::Mul(height, height);
      square = hn::Sub(square, height_square);
      const V inside = hn::Max(hn::NegMulAdd(height_square, flatten_, hn::Set(d, 1.0f)), hn::Zero(d));
      factor = hn::Mul(factor, hn::Mul(inside, inside));
    }
    v = hn::Max(hn::NegMulAdd(square, shrink_, hn::Set(d, 0.5f)), hn::Set(d, -0.5f));
    const V t = hn::Add(v, hn::Set(d, 0.5f));
    factor = hn::Mul(factor, hn::Mul(t, t));
    if constexpr (kFade) factor = hn::Mul(factor, fade(i));
    if constexpr (kOriented) {
      V cosine, sine;
      CosineSine(d, dot<kDim>(offset, wave_), cosine, sine);
      factor = hn::Mul(factor, cosine);
    }
  }

 private:
  template <int kTerms>
  static HWY_INLINE V dot(const V* a, const V* b) {
    V sum = hn::Mul(a[0], b[0]);
    for (int axis = 1; axis < kTerms; ++axis) sum = hn::MulAdd(a[axis], b[axis], sum);
    return sum;
  }

  // ScaleFade of kDim dimensions.
  HWY_INLINE V fade(std::size_t i) const {
    const Tag d;
    constexpr float kLowest = 1.0f / static_cast<float>(1 << kDim);
    constexpr float kPerRise = 2.0f / kLowest;
    constexpr float kPerFall = 4.0f;
    const V y = hn::Mul(density_, hn::Set(d, impulses_.attribute(PointImpulses::kTurn)[i]));
    const V in = hn::MulAdd(y, hn::Set(d, kPerRise), hn::Set(d, -kLowest * kPerRise));
    const V out = hn::NegMulAdd(y, hn::Set(d, kPerFall), hn::Set(d, kPerFall));
    const V x = hn::Max(hn::Min(hn::Min(in, out), hn::Set(d, 1.0f)), hn::Zero(d));
    return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(x, hn::Set(d, 2.0f), hn::Set(d, 3.0f)));
  }

  const PointImpulses& impulses_;
  V at_[kDim];
  V wave_[kDim];
  V normal_[3];
  V shrink_;
  V density_;
  V flatten_;
};

template <int kDim, bool kLayer, bool kOriented, bool kFade, class Polynomial>
HWY_NOINLINE void Sum(const PointCluster& cluster, const PointPolynomials& polynomials,
                      const PointImpulses& impulses, float* values) {
  const Tag d;
  for (int lane = 0; lane < cluster.count; lane += static_cast<int>(hn::Lanes(d))) {
    const Polynomial polynomial(polynomials, lane);
    const PointTerms<kDim, kLayer, kOriented, kFade> terms(cluster, impulses, lane);
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i < impulses.size(); i += 2) {
      V v0, v1, factor0, factor1, p0, p1;
      terms.term(i, v0, factor0);
      terms.term(i + 1, v1, factor1);
      polynomial(v0, v1, p0, p1);
      sum = hn::MulAdd(factor0, p0, sum);
      sum = hn::MulAdd(factor1, p1, sum);
    }
    hn::Store(sum, d, values + lane);
  }
}

template <int kDim, bool kLayer, bool kOriented, bool kFade>
void SumWithPolynomial(const PointCluster& cluster, const PointPolynomials& polynomials,
                       const PointImpulses& impulses, float* values) {
  if (!polynomials.power) {
    return Sum<kDim, kLayer, kOriented, kFade, PointClenshaw>(cluster, polynomials, impulses, values);
  }
  if (polynomials.degree <= 4) {
    return Sum<kDim, kLayer, kOriented, kFade, PointHorner<4>>(cluster, polynomials, impulses, values);
  }
  if (polynomials.degree <= 8) {
    return Sum<kDim, kLayer, kOriented, kFade, PointHorner<8>>(cluster, polynomials, impulses, values);
  }
  return Sum<kDim, kLayer, kOriented, kFade, PointHorner<12>>(cluster, polynomials, impulses, values);
}

template <int kDim, bool kLayer>
void SumOfDimension(const PointKernel& kernel, const PointCluster& cluster,
                    const PointPolynomials& polynomials, const PointImpulses& impulses, float* values) {
  if (kernel.oriented) {
    kernel.fade ? SumWithPolynomial<kDim, kLayer, true, true>(cluster, polynomials, impulses, values)
                : SumWithPolynomial<kDim, kLayer, true, false>(cluster, polynomials, impulses, values);
  } else {
    kernel.fade ? SumWithPolynomial<kDim, kLayer, false, true>(cluster, polynomials, impulses, values)
                : SumWithPolynomial<kDim, kLayer, false, false>(cluster, polynomials, impulses, values);
  }
}

}  // namespace point_sum

inline void SumPointImpulses(const PointKernel& kernel, const PointCluster& cluster,
                             const PointPolynomials& polynomials, const PointImpulses& impulses,
                             float* values) {
  if (kernel.layer) return point_sum::SumOfDimension<3, true>(kernel, cluster, polynomials, impulses, values);
  switch (kernel.dimensions) {
    case 2:
      return point_sum::SumOfDimension<2, false>(kernel, cluster, polynomials, impulses, values);
    case 3:
      return point_sum::SumOfDimension<3, false>(kernel, cluster, polynomials, impulses, values);
    default:
      return point_sum::SumOfDimension<4, false>(kernel, cluster, polynomials, impulses, values);
  }
}

// The margin keeps what rounding might wrongly drop.
inline void CullPointImpulses(const PointImpulses& impulses, const PointCull& cull, PointImpulses& kept) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  kept.reserve(kept.size() + impulses.size());
  std::size_t end = kept.size();
  const V reach_square = hn::Set(d, cull.reach * cull.reach * kSupportWithMargin);
  for (std::size_t i = 0; i < impulses.size(); i += hn::Lanes(d)) {
    V square = hn::Zero(d);
    for (int axis = 0; axis < cull.dimensions; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const V excess =
          Excess(d, hn::LoadU(d, impulses.position(axis) + i), cull.lower[a], cull.upper[a], 1.0f);
      square = hn::MulAdd(excess, excess, square);
    }
    V along = hn::Mul(hn::LoadU(d, impulses.position(0) + i), hn::Set(d, cull.normal[0]));
    along = hn::MulAdd(hn::LoadU(d, impulses.position(1) + i), hn::Set(d, cull.normal[1]), along);
    along = hn::MulAdd(hn::LoadU(d, impulses.position(2) + i), hn::Set(d, cull.normal[2]), along);
    const V turn = hn::LoadU(d, impulses.attribute(PointImpulses::kTurn) + i);
    auto keep =
        hn::And(hn::Lt(square, reach_square), hn::FirstN(d, std::min(hn::Lanes(d), impulses.size() - i)));
    keep =
        hn::And(keep, hn::And(hn::Ge(along, hn::Set(d, cull.below)), hn::Le(along, hn::Set(d, cull.above))));
    keep = hn::And(
        keep, hn::And(hn::Ge(turn, hn::Set(d, cull.least_turn)), hn::Le(turn, hn::Set(d, cull.most_turn))));
    for (int axis = 0; axis < cull.dimensions; ++axis) {
      StoreKept(d, hn::LoadU(d, impulses.position(axis) + i), keep, kept.position(axis) + end);
    }
    for (int channel = 0; channel < cull.attributes; ++channel) {
      StoreKept(d, hn::LoadU(d, impulses.attribute(channel) + i), keep, kept.attribute(channel) + end);
    }
    end += hn::CountTrue(d, keep);
  }
  kept.set_size(end);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POINT_SUM_INL
