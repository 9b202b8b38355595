// Interpolation along one axis, for one instruction set. Included once per target; see
// interpolate_axis_simd.cpp.
#include <algorithm>
#include <cstddef>

#include <hwy/highway.h>

#include "solidnoise/noise/interpolation/interpolate_axis.h"

#if defined(SOLIDNOISE_INTERPOLATE_AXIS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_INTERPOLATE_AXIS_INL
#undef SOLIDNOISE_INTERPOLATE_AXIS_INL
#else
#define SOLIDNOISE_INTERPOLATE_AXIS_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Sums the weighted rows for the values that fill whole vectors of D; returns how many these are.
template <class D>
HWY_INLINE std::size_t SumRows(D d, int taps, const float* weight, std::size_t stride, std::size_t begin,
                               std::size_t end, const float* in, float* out) {
  const std::size_t lanes = hn::Lanes(d);
  for (; begin + lanes <= end; begin += lanes) {
    auto sum = hn::Zero(d);
    for (int t = 0; t < taps; ++t) {
      sum = hn::MulAdd(hn::Set(d, weight[t]), hn::LoadU(d, in + static_cast<std::size_t>(t) * stride + begin),
                       sum);
    }
    hn::StoreU(sum, d, out + begin);
  }
  return begin;
}

// Along an axis whose rows are long: each row is a sum of rows.
HWY_INLINE void InterpolateRows(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out) {
  const hn::ScalableTag<float> wide;
  const hn::CappedTag<float, 8> narrow;
  const hn::CappedTag<float, 1> single;
  const std::size_t count = axis.count();
  for (std::size_t o = 0; o < shape.outer; ++o) {
    for (std::size_t i = 0; i < count; ++i) {
      const float* const from = in + (o * shape.in + axis.first(i)) * shape.inner;
      const float* const weight = axis.weights(i);
      float* const to = out + (o * count + i) * shape.inner;
      std::size_t done = SumRows(wide, axis.taps(), weight, shape.inner, 0, shape.inner, from, to);
      done = SumRows(narrow, axis.taps(), weight, shape.inner, done, shape.inner, from, to);
      SumRows(single, axis.taps(), weight, shape.inner, done, shape.inner, from, to);
    }
  }
}

// Along the last axis: tile by tile, for all rows.
HWY_INLINE void InterpolateLastAxis(const AxisTaps& axis, const AxisShape& shape, const float* in,
                                    float* out) {
  constexpr std::size_t kSide = AxisTaps::Tile::kSide;
  const hn::CappedTag<float, kSide> d;
  const std::size_t lanes = hn::Lanes(d);
  for (const AxisTaps::Tile& tile : axis.tiles()) {
    const std::size_t columns = tile.columns.size();
    for (std::size_t o = 0; o < shape.outer; ++o) {
      const float* const from = in + o * shape.in + tile.first;
      float* const to = out + o * axis.count() + tile.begin;
      HWY_ALIGN float sums[kSide];
      for (std::size_t lane = 0; lane < kSide; lane += lanes) {
        auto sum = hn::Zero(d);
        for (std::size_t k = 0; k < columns; ++k) {
          sum = hn::MulAdd(hn::Set(d, from[k]), hn::LoadU(d, tile.columns[k].data() + lane), sum);
        }
        hn::Store(sum, d, sums + lane);
      }
      std::copy_n(sums, tile.count, to);
    }
  }
}

void InterpolateAxis(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out) {
  if (shape.inner == 1) {
    InterpolateLastAxis(axis, shape, in, out);
  } else {
    InterpolateRows(axis, shape, in, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_INTERPOLATE_AXIS_INL
