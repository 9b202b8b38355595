// Dispatch of the search for the nearest impulses to the instruction sets that it was compiled for.
#include "solidnoise/noise/cellular/nearest.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/cellular/nearest_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/cellular/nearest-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(FindNearest);
HWY_EXPORT(FindNearestScattered);

void find_nearest(const NearestDistance& nearest, const ImpulseList& list, const SampleBrick& brick,
                  Derivatives derivatives, BrickSums& distances) {
  HWY_DYNAMIC_DISPATCH(FindNearest)(nearest, list, brick, derivatives, distances);
}

void find_nearest(const NearestDistance& nearest, const ImpulseList& list, const SampleCluster& cluster,
                  Derivatives derivatives, ClusterSums& distances) {
  HWY_DYNAMIC_DISPATCH(FindNearestScattered)(nearest, list, cluster, derivatives, distances);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
