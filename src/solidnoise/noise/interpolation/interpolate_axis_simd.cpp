// Dispatch of interpolation to the instruction sets that it was compiled for.
#include "solidnoise/noise/interpolation/interpolate_axis.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/interpolation/interpolate_axis_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/interpolation/interpolate_axis-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(InterpolateLastAxis);
HWY_EXPORT(InterpolateAxis);

void interpolate_last_axis(const AxisTaps& axis, const SampleRows& rows, float* out) {
  HWY_DYNAMIC_DISPATCH(InterpolateLastAxis)(axis, rows, out);
}

void interpolate_axis(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out) {
  HWY_DYNAMIC_DISPATCH(InterpolateAxis)(axis, shape, in, out);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
