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
      : list_(list), kernel_(PointTag(), sum.kernel) {
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
    if constexpr (kDerivatives != Derivatives::alone) value_ = kernel_.value.add_to(value_, d, t, weight);
    if constexpr (kDerivatives != Derivatives::none) {
      const V slope = kernel_.slope.of(d, t, weight);
      for (int role = 0; role < kRoles; ++role) {
        gradient_[role] = hn::MulAdd(slope, offset[role], gradient_[role]);
      }
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    const PointTag d;
    hn::Store(value_, d, sums.value + lane);
    if constexpr (kDerivatives != Derivatives::none) {
      const V chain = hn::Set(d, -2.0f);  // d t / d offset = -2 offset
      for (int role = 0; role < kRoles; ++role) {
        hn::Store(hn::Mul(chain, gradient_[role]), d, sums.gradient[role] + lane);
      }
    }
  }

 private:
  using V = PointVector;
  const ImpulseList& list_;
  RadialKernel<kRadialTaper, Polynomial, PointTag> kernel_;
  V at_[kRoles];
  V scale_[kRoles];
  V value_ = hn::Zero(PointTag());
  V gradient_[kRoles];
};

// Calls the sum that is compiled for the polynomial and for what is wanted.
template <class Sum>
HWY_INLINE void WithDerivatives(const RadialPolynomial& kernel, Derivatives derivatives, const Sum& sum) {
  WithPolynomial<RadialSum::kMostDegree>(kernel, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    switch (derivatives) {
      case Derivatives::none:
        return sum.template operator()<Polynomial, Derivatives::none>();
      case Derivatives::gradient:
        return sum.template operator()<Polynomial, Derivatives::gradient>();
      case Derivatives::alone:
        return sum.template operator()<Polynomial, Derivatives::alone>();
    }
  });
}

inline void SumRadial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      Derivatives derivatives, BrickSums& sums) {
  WithDerivatives(sum.kernel, derivatives, [&]<class Polynomial, Derivatives kDerivatives>() {
    SumRadialBrick<Polynomial, kDerivatives>(sum, list, brick, sums);
  });
}

inline void SumRadialScattered(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                               Derivatives derivatives, ClusterSums& sums) {
  WithDerivatives(sum.kernel, derivatives, [&]<class Polynomial, Derivatives kDerivatives>() {
    SumTerms<RadialTerms<Polynomial, kDerivatives>>(sum, cluster, list, sums);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_RADIAL_SUM_INL
