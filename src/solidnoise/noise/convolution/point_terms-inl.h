// The loop over the impulses near scattered points, for one instruction set. Included once per target.
#include <cstddef>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"

#if defined(SOLIDNOISE_POINT_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_POINT_TERMS_INL
#undef SOLIDNOISE_POINT_TERMS_INL
#else
#define SOLIDNOISE_POINT_TERMS_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Lanes are points.
using PointTag = hn::CappedTag<float, SampleCluster::kSamples>;
using PointVector = hn::Vec<PointTag>;

// Sums `Terms` over the list, impulse by impulse in its order. They are made of a kernel, a cluster, the list
// and the first lane; add(i) takes kAtOnce impulses from i on, store() writes the sums of a vector of points.
template <class Terms, class Kernel, class Cluster>
HWY_NOINLINE void SumTerms(const Kernel& kernel, const Cluster& cluster, const ImpulseList& list,
                           ClusterSums& sums) {
  for (int lane = 0; lane < cluster.count; lane += static_cast<int>(hn::Lanes(PointTag()))) {
    Terms terms(kernel, cluster, list, lane);
    for (std::size_t i = 0; i < list.size(); i += Terms::kAtOnce) terms.add(i);
    terms.store(lane, sums);
  }
}

template <int kTerms>
HWY_INLINE PointVector Dot(const PointVector* a, const PointVector* b) {
  PointVector sum = hn::Mul(a[0], b[0]);
  for (int axis = 1; axis < kTerms; ++axis) sum = hn::MulAdd(a[axis], b[axis], sum);
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_POINT_TERMS_INL
