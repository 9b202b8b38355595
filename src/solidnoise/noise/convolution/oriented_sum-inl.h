// Sums of oriented kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <type_traits>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/oriented_brick-inl.h"
#include "solidnoise/noise/convolution/oriented_factor-inl.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"

#if defined(SOLIDNOISE_ORIENTED_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_ORIENTED_SUM_INL
#undef SOLIDNOISE_ORIENTED_SUM_INL
#else
#define SOLIDNOISE_ORIENTED_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At scattered samples; the same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
class OrientedTerms {
 public:
  static constexpr std::size_t kAtOnce = 1;

  HWY_INLINE OrientedTerms(const OrientedSum& sum, const SampleCluster& cluster, const ImpulseList& list,
                           int lane)
      : sum_(sum), cluster_(cluster), list_(list), lane_(lane), envelope_(PointTag(), sum.envelope) {
    for (V& derivative : gradient_) derivative = hn::Zero(PointTag());
  }

  HWY_INLINE void add(std::size_t i) {
    AxisFactor<V> x = factor(kX, i);
    const AxisFactor<V> y = factor(kY, i), z = factor(kZ, i), t = factor(kT, i);
    const Complex<V> x_by_time = Multiply(x.value, t.derivative);
    if (sum_.scale[kT] != 0.0f) {
      x.value = Multiply(x.value, t.value);
      x.derivative = Multiply(x.derivative, t.value);
    }
    value_ = AddRealProduct(Multiply(y.value, z.value), x.value, value_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      gradient_[kX] = AddRealProduct(Multiply(y.value, z.value), x.derivative, gradient_[kX]);
      gradient_[kY] = AddRealProduct(Multiply(y.derivative, z.value), x.value, gradient_[kY]);
      gradient_[kZ] = AddRealProduct(Multiply(y.value, z.derivative), x.value, gradient_[kZ]);
      gradient_[kT] = AddRealProduct(Multiply(y.value, z.value), x_by_time, gradient_[kT]);
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    const PointTag d;
    hn::Store(value_, d, sums.value + lane);
    if constexpr (kDerivatives == Derivatives::gradient) {
      for (int role = 0; role < kRoles; ++role) hn::Store(gradient_[role], d, sums.gradient[role] + lane);
    }
  }

 private:
  using V = PointVector;

  HWY_INLINE AxisFactor<V> factor(Role role, std::size_t i) const {
    const PointTag d;
    const V zero = hn::Zero(d);
    if (sum_.scale[role] == 0.0f) return {{hn::Set(d, 1.0f), zero}, {zero, zero}};
    const V offset =
        hn::Sub(hn::Load(d, cluster_.coordinate[role] + lane_), hn::Set(d, list_.position(role)[i]));
    const V phase = role == kZ ? hn::Set(d, list_.attribute(OrientedSum::kPhase)[i]) : zero;
    const bool weighs = role == kZ && sum_.weighted;
    const V weight = hn::Set(d, weighs ? list_.attribute(OrientedSum::kWeight)[i] : 1.0f);
    return FactorAlongAxis<kDerivatives>(d, envelope_, offset,
                                         hn::Set(d, list_.attribute(OrientedSum::wave(role))[i]), phase,
                                         weight, sum_.scale[role]);
  }

  const OrientedSum& sum_;
  const SampleCluster& cluster_;
  const ImpulseList& list_;
  int lane_;
  RadialKernel<kAxisTaper, Polynomial, PointTag> envelope_;
  V value_ = hn::Zero(PointTag());
  V gradient_[kRoles];
};

template <class Samples, class SamplesSums>
HWY_INLINE void SumOriented(const OrientedSum& sum, const ImpulseList& list, const Samples& samples,
                            Derivatives derivatives, SamplesSums& sums) {
  WithPolynomial<OrientedSum::kMostDegree>(sum.envelope, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if constexpr (std::is_same_v<Samples, SampleBrick>) {
      derivatives == Derivatives::none
          ? SumOrientedBrick<Polynomial, Derivatives::none>(sum, list, samples, derivatives, sums)
          : SumOrientedBrick<Polynomial, Derivatives::gradient>(sum, list, samples, derivatives, sums);
    } else {
      derivatives == Derivatives::none
          ? SumTerms<OrientedTerms<Polynomial, Derivatives::none>>(sum, samples, list, sums)
          : SumTerms<OrientedTerms<Polynomial, Derivatives::gradient>>(sum, samples, list, sums);
    }
  });
}

inline void SumOrientedLattice(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                               Derivatives derivatives, BrickSums& sums) {
  SumOriented(sum, list, brick, derivatives, sums);
}

inline void SumOrientedScattered(const OrientedSum& sum, const ImpulseList& list,
                                 const SampleCluster& cluster, Derivatives derivatives, ClusterSums& sums) {
  SumOriented(sum, list, cluster, derivatives, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_ORIENTED_SUM_INL
