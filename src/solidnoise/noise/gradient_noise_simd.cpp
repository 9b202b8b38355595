#include "solidnoise/noise/gradient_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/gradient_noise_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which must come first.
#include <hwy/highway.h>

#include "solidnoise/noise/gradient_noise-inl.h"

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {

void sum_gradient_tile(const GradientSum& sum, const GradientTile& tile, GradientOutput output,
                       GradientTileResults& results) {
  gradient_noise::sum_any(sum, tile, output, results);
}

void sum_gradient_cluster(const GradientSum& sum, const GradientCluster& cluster, GradientOutput output,
                          GradientClusterResults& results) {
  gradient_noise::sum_any(sum, cluster, output, results);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(sum_gradient_tile);
HWY_EXPORT(sum_gradient_cluster);

void sum_gradient_noise(const GradientSum& sum, const GradientTile& tile, GradientOutput output,
                        GradientTileResults& results) {
  HWY_DYNAMIC_DISPATCH(sum_gradient_tile)(sum, tile, output, results);
}

void sum_gradient_noise(const GradientSum& sum, const GradientCluster& cluster, GradientOutput output,
                        GradientClusterResults& results) {
  HWY_DYNAMIC_DISPATCH(sum_gradient_cluster)(sum, cluster, output, results);
}

}  // namespace solidnoise
#endif
