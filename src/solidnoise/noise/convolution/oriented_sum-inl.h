// Sums of oriented kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <type_traits>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/oriented_brick-inl.h"
#include "solidnoise/noise/convolution/oriented_factor-inl.h"
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

// Lanes are the scattered samples. The same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
void SumOrientedCluster(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                        ClusterSums& sums) {
  const hn::CappedTag<float, SampleCluster::kSamples> d;
  using V = hn::Vec<decltype(d)>;
  const typename Polynomial::template Bound<decltype(d)> envelope(d, sum.envelope);
  const V zero = hn::Zero(d);

  for (int piece = 0; piece < cluster.count; piece += static_cast<int>(hn::Lanes(d))) {
    V value = zero;
    V gx = zero, gy = zero, gz = zero, gt = zero;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto factor = [&](Role role) HWY_ATTR {
        if (sum.scale[role] == 0.0f) return AxisFactor<V>{{hn::Set(d, 1.0f), zero}, {zero, zero}};
        const V offset =
            hn::Sub(hn::Load(d, cluster.coordinate[role] + piece), hn::Set(d, list.position(role)[i]));
        const V phase = role == kZ ? hn::Set(d, list.attribute(OrientedSum::kPhase)[i]) : zero;
        return FactorAlongAxis<kDerivatives>(d, envelope, offset,
                                             hn::Set(d, list.attribute(OrientedSum::wave(role))[i]), phase,
                                             sum.scale[role]);
      };
      AxisFactor<V> x = factor(kX);
      const AxisFactor<V> y = factor(kY), z = factor(kZ), t = factor(kT);
      const Complex<V> x_by_time = Multiply(x.value, t.derivative);
      if (sum.scale[kT] != 0.0f) {
        x.value = Multiply(x.value, t.value);
        x.derivative = Multiply(x.derivative, t.value);
      }
      value = AddRealProduct(Multiply(y.value, z.value), x.value, value);
      if constexpr (kDerivatives == Derivatives::gradient) {
        gx = AddRealProduct(Multiply(y.value, z.value), x.derivative, gx);
        gy = AddRealProduct(Multiply(y.derivative, z.value), x.value, gy);
        gz = AddRealProduct(Multiply(y.value, z.derivative), x.value, gz);
        gt = AddRealProduct(Multiply(y.value, z.value), x_by_time, gt);
      }
    }
    hn::Store(value, d, sums.value + piece);
    if constexpr (kDerivatives == Derivatives::gradient) {
      hn::Store(gx, d, sums.gradient[kX] + piece);
      hn::Store(gy, d, sums.gradient[kY] + piece);
      hn::Store(gz, d, sums.gradient[kZ] + piece);
      hn::Store(gt, d, sums.gradient[kT] + piece);
    }
  }
}

template <class Samples, class SamplesSums>
HWY_INLINE void SumOriented(const OrientedSum& sum, const ImpulseList& list, const Samples& samples,
                            Derivatives derivatives, SamplesSums& sums) {
  WithPolynomial<OrientedSum::kFactored.degree>(sum.envelope, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if constexpr (std::is_same_v<Samples, SampleBrick>) {
      derivatives == Derivatives::none
          ? SumOrientedBrick<Polynomial, Derivatives::none>(sum, list, samples, sums)
          : SumOrientedBrick<Polynomial, Derivatives::gradient>(sum, list, samples, sums);
    } else {
      derivatives == Derivatives::none
          ? SumOrientedCluster<Polynomial, Derivatives::none>(sum, list, samples, sums)
          : SumOrientedCluster<Polynomial, Derivatives::gradient>(sum, list, samples, sums);
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
