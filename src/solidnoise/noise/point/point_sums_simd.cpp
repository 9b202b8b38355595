// Dispatch of the loops over points to the instruction sets that they were compiled for.
#include "solidnoise/noise/point/point_cluster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/point/point_sums_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/point/point_sum-inl.h"
#include "solidnoise/noise/point/surface_sum-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(SumPointImpulses);
HWY_EXPORT(SumLayerWaves);
HWY_EXPORT(SumProjected);

void sum_impulses(const PointKernel& kernel, const PointCluster& cluster, const PointPolynomials& polynomials,
                  ImpulseList& impulses, ClusterSums& sums) {
  if (impulses.size() % 2 == 1) {
    const std::size_t last = impulses.size();
    impulses.reserve(last + 1);
    for (int role = 0; role < kRoles; ++role) impulses.position(role)[last] = 0.0f;
    impulses.attribute(kWeight)[last] = 0.0f;
    impulses.attribute(kTurn)[last] = 0.0f;
    impulses.set_size(last + 1);
  }
  HWY_DYNAMIC_DISPATCH(SumPointImpulses)(kernel, cluster, polynomials, impulses, sums);
}

void sum_layer_waves(const LayerWaveKernel& kernel, const PointCluster& cluster, const ImpulseList& impulses,
                     ClusterSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumLayerWaves)(kernel, cluster, impulses, sums);
}

void sum_projected(const ProjectedKernel& kernel, const PointCluster& cluster, const ImpulseList& impulses,
                   ClusterSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumProjected)(kernel, cluster, impulses, sums);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
