#include "solidnoise/noise/gradient/gradient_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/gradient/gradient_noise_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which must come first.
#include <hwy/highway.h>

#include "solidnoise/noise/gradient/gradient_cluster_sum-inl.h"
#include "solidnoise/noise/gradient/gradient_tile_sum-inl.h"

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {

template <int kDim, typename Batch, typename Results>
void sum_terms(const GradientSum& sum, const Batch& batch, Derivatives derivatives, Results& results) {
  if (derivatives == Derivatives::none) {
    sum_terms<kDim, Derivatives::none>(sum, batch, results);
  } else {
    sum_terms<kDim, Derivatives::gradient>(sum, batch, results);
  }
}

template <typename Batch, typename Results>
void sum_terms(const GradientSum& sum, const Batch& batch, Derivatives derivatives, Results& results) {
  switch (sum.dimensions) {
    case 1:
      return sum_terms<1>(sum, batch, derivatives, results);
    case 2:
      return sum_terms<2>(sum, batch, derivatives, results);
    case 3:
      return sum_terms<3>(sum, batch, derivatives, results);
    default:
      return sum_terms<4>(sum, batch, derivatives, results);
  }
}

}  // namespace gradient_noise

void sum_gradient_tile(const GradientSum& sum, const GradientTile& tile, Derivatives derivatives,
                       GradientTileSums& results) {
  gradient_noise::sum_terms(sum, tile, derivatives, results);
}

void sum_gradient_cluster(const GradientSum& sum, const GradientCluster& cluster, Derivatives derivatives,
                          ClusterSums& results) {
  gradient_noise::sum_terms(sum, cluster, derivatives, results);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(sum_gradient_tile);
HWY_EXPORT(sum_gradient_cluster);

void sum_gradient_noise(const GradientSum& sum, const GradientTile& tile, Derivatives derivatives,
                        GradientTileSums& results) {
  HWY_DYNAMIC_DISPATCH(sum_gradient_tile)(sum, tile, derivatives, results);
}

void sum_gradient_noise(const GradientSum& sum, const GradientCluster& cluster, Derivatives derivatives,
                        ClusterSums& results) {
  HWY_DYNAMIC_DISPATCH(sum_gradient_cluster)(sum, cluster, derivatives, results);
}

}  // namespace solidnoise
#endif
