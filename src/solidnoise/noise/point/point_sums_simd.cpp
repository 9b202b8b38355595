// Dispatch of the loops over points to the instruction sets that they were compiled for.
#include "solidnoise/noise/point/point_cluster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/point/point_sums_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/point/layer_wave_sum-inl.h"
#include "solidnoise/noise/point/point_sum-inl.h"
#include "solidnoise/noise/point/projected_sum-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(CullPointImpulses);
HWY_EXPORT(SumPointImpulses);
HWY_EXPORT(SumLayerWaves);
HWY_EXPORT(SumProjected);

void cull_impulses(const PointImpulses& impulses, const PointCull& cull, PointImpulses& kept) {
  HWY_DYNAMIC_DISPATCH(CullPointImpulses)(impulses, cull, kept);
}

void sum_impulses(const PointKernel& kernel, const PointCluster& cluster, const PointPolynomials& polynomials,
                  PointImpulses& impulses, float* values) {
  if (impulses.size() % 2 == 1) {
    impulses.reserve(impulses.size() + 1);
    for (int axis = 0; axis < kernel.dimensions; ++axis) impulses.position(axis)[impulses.size()] = 0.0f;
    impulses.attribute(PointImpulses::kWeight)[impulses.size()] = 0.0f;
    impulses.attribute(PointImpulses::kTurn)[impulses.size()] = 0.0f;
    impulses.set_size(impulses.size() + 1);
  }
  HWY_DYNAMIC_DISPATCH(SumPointImpulses)(kernel, cluster, polynomials, impulses, values);
}

void sum_layer_waves(const LayerWaveKernel& kernel, const PointCluster& cluster,
                     const PointImpulses& impulses, float* values) {
  HWY_DYNAMIC_DISPATCH(SumLayerWaves)(kernel, cluster, impulses, values);
}

void sum_projected(const ProjectedKernel& kernel, const PointCluster& cluster, const PointImpulses& impulses,
                   float* values) {
  HWY_DYNAMIC_DISPATCH(SumProjected)(kernel, cluster, impulses, values);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
