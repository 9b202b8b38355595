// Dispatch of interpolation at points to the instruction sets that it was compiled for.
#include "solidnoise/noise/interpolation/interpolate_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/interpolation/interpolate_points_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/interpolation/interpolate_points-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(InterpolatePoints);

void interpolate_points(const PointWeights& weights, const SampleRows& rows,
                        std::span<const PlacedPoint> points, float* out) {
  HWY_DYNAMIC_DISPATCH(InterpolatePoints)(weights, rows, points, out);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
