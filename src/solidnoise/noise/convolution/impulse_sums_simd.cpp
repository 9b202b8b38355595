// Dispatch of the impulse loops to the instruction sets that they were compiled for.
#include "solidnoise/noise/convolution/impulse_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/convolution/impulse_sums_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/convolution/impulse_cull-inl.h"
#include "solidnoise/noise/convolution/oriented_sum-inl.h"
#include "solidnoise/noise/convolution/radial_sum-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(CullRun);
HWY_EXPORT(CullList);
HWY_EXPORT(SumRadial);
HWY_EXPORT(SumRadialScattered);
HWY_EXPORT(SumOrientedLattice);
HWY_EXPORT(SumOrientedScattered);

void cull_impulses(const ImpulseRun& run, const CullBox& box, ImpulseList& list) {
  HWY_DYNAMIC_DISPATCH(CullRun)(run, box, list);
}

void cull_impulses(const ImpulseList& impulses, const PointCull& cull, ImpulseList& list) {
  PointCull scaled = cull;
  scaled.scale.fill(1.0f / cull.reach);
  HWY_DYNAMIC_DISPATCH(CullList)(impulses, scaled, list);
}

void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                Derivatives derivatives, BrickSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumRadial)(sum, list, brick, derivatives, sums);
}

void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                Derivatives derivatives, ClusterSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumRadialScattered)(sum, list, cluster, derivatives, sums);
}

void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                  Derivatives derivatives, BrickSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumOrientedLattice)(sum, list, brick, derivatives, sums);
}

void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                  Derivatives derivatives, ClusterSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumOrientedScattered)(sum, list, cluster, derivatives, sums);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
