// Sums of isotropic kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <cstddef>
#include <type_traits>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"
#include "solidnoise/noise/convolution/radial_brick-inl.h"

#if defined(SOLIDNOISE_RADIAL_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_RADIAL_SUM_INL
#undef SOLIDNOISE_RADIAL_SUM_INL
#else
#define SOLIDNOISE_RADIAL_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At scattered samples; the same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
class RadialTerms {
 public:
  static constexpr std::size_t kAtOnce = 1;

  HWY_INLINE RadialTerms(const RadialSum& sum, const SampleCluster& cluster, const ImpulseList& list,
                         int lane)
      : list_(list), polynomial_(PointTag(), sum.kernel) {
    const PointTag d;
    for (int role = 0; role < kRoles; ++role) {
      at_[role] = hn::Load(d, cluster.coordinate[role] + lane);
      scale_[role] = hn::Set(d, sum.scale[static_cast<std::size_t>(role)]);
      gradient_[role] = hn::Zero(d);
    }
  }

  HWY_INLINE void add(std::size_t i) {
    const PointTag d;
    V offset[kRoles];
    for (int role = 0; role < kRoles; ++role) {
      offset[role] = hn::Mul(hn::Sub(at_[role], hn::Set(d, list_.position(role)[i])), scale_[role]);
    }
    const V plane_squared = hn::MulAdd(offset[kZ], offset[kZ], hn::Mul(offset[kY], offset[kY]));
    const V rest = hn::Sub(hn::Sub(hn::Set(d, 1.0f), hn::Mul(offset[kT], offset[kT])), plane_squared);
    const V t = PositivePart(d, hn::Sub(rest, hn::Mul(offset[kX], offset[kX])));
    const V weight = hn::Set(d, list_.attribute(0)[i]);
    const RadialTerm<kRadialTaper, kDerivatives, PointTag, Bound> term(d, polynomial_, t, weight);
    value_ = term.add_to(value_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const V slope = term.derivative();
      for (int role = 0; role < kRoles; ++role) {
        gradient_[role] = hn::MulAdd(slope, offset[role], gradient_[role]);
      }
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    const PointTag d;
    hn::Store(value_, d, sums.value + lane);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const V chain = hn::Set(d, -2.0f);  // d t / d offset = -2 offset
      for (int role = 0; role < kRoles; ++role) {
        hn::Store(hn::Mul(chain, gradient_[role]), d, sums.gradient[role] + lane);
      }
    }
  }

 private:
  using V = PointVector;
  using Bound = typename Polynomial::template Bound<PointTag>;

  const ImpulseList& list_;
  Bound polynomial_;
  V at_[kRoles];
  V scale_[kRoles];
  V value_ = hn::Zero(PointTag());
  V gradient_[kRoles];
};

inline void SumRadial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      Derivatives derivatives, BrickSums& sums) {
  WithPolynomial<RadialSum::kMostDegree>(sum.kernel, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if (derivatives == Derivatives::none) {
      SumRadialBrick<Polynomial, Derivatives::none>(sum, list, brick, sums);
    } else {
      SumRadialBrick<Polynomial, Derivatives::gradient>(sum, list, brick, sums);
    }
  });
}

inline void SumRadialScattered(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                               Derivatives derivatives, ClusterSums& sums) {
  WithPolynomial<RadialSum::kMostDegree>(sum.kernel, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if (derivatives == Derivatives::none) {
      SumTerms<RadialTerms<Polynomial, Derivatives::none>>(sum, cluster, list, sums);
    } else {
      SumTerms<RadialTerms<Polynomial, Derivatives::gradient>>(sum, cluster, list, sums);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_RADIAL_SUM_INL
