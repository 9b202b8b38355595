// Interpolation at points, for one instruction set. Included once per target; see
// interpolate_points_simd.cpp.
#include <algorithm>
#include <array>
#include <cstddef>

#include <hwy/highway.h>

#include "solidnoise/noise/interpolation/interpolate_points.h"

#if defined(SOLIDNOISE_INTERPOLATE_POINTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_INTERPOLATE_POINTS_INL
#undef SOLIDNOISE_INTERPOLATE_POINTS_INL
#else
#define SOLIDNOISE_INTERPOLATE_POINTS_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Four lanes are enough: a row has no more samples than twice that, and the next points go beside.
using Lanes = hn::CappedTag<float, 4>;

// The weights of a place along an axis.
HWY_INLINE void WeighTaps(const PointWeights& weights, std::size_t axis, float place, float* out) {
  const Lanes d;
  const int whole = std::min(static_cast<int>(place), PointWeights::kPlaces - 1);
  const std::array<float, PointWeights::kMostTaps>* const row =
      &weights.of_axis[axis][static_cast<std::size_t>(whole)];
  const auto beyond = hn::Set(d, place - static_cast<float>(whole));
  for (std::size_t tap = 0; tap < PointWeights::kMostTaps; tap += hn::Lanes(d)) {
    const auto here = hn::LoadU(d, row[0].data() + tap);
    const auto next = hn::LoadU(d, row[1].data() + tap);
    hn::StoreU(hn::MulAdd(beyond, hn::Sub(next, here), here), d, out + tap);
  }
}

// The sums over rows of as many of their samples as there are lanes.
template <int kTaps>
HWY_INLINE hn::Vec<Lanes> SumRowsAround(const float* first, const SampleRows& rows, const float* along_x,
                                        const float* along_y) {
  const Lanes d;
  auto sum = hn::Zero(d);
  for (std::size_t x = 0; x < kTaps; ++x) {
    const float* const slab = first + x * rows.slab_stride;
    auto of_slab = hn::Zero(d);
    for (std::size_t y = 0; y < kTaps; ++y) {
      of_slab = hn::MulAdd(hn::Set(d, along_y[y]), hn::LoadU(d, slab + y * rows.row_stride), of_slab);
    }
    sum = hn::MulAdd(hn::Set(d, along_x[x]), of_slab, sum);
  }
  return sum;
}

// Rows of more than four samples are taken as the first four, and the last four without those among the
// first.
template <int kTaps>
HWY_INLINE void SumAtPoints(const PointWeights& weights, const SampleRows& rows,
                            std::span<const PlacedPoint> points, float* out) {
  const Lanes d;
  constexpr std::size_t kSide = 4;
  constexpr std::size_t kLast = kTaps - kSide;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlacedPoint& point = points[i];
    float along_x[PointWeights::kMostTaps];
    float along_y[PointWeights::kMostTaps];
    float along_z[PointWeights::kMostTaps];
    WeighTaps(weights, 0, point.place[0], along_x);
    WeighTaps(weights, 1, point.place[1], along_y);
    WeighTaps(weights, 2, point.place[2], along_z);
    float sums[kSide] = {};
    for (std::size_t lane = 0; lane < kSide; lane += hn::Lanes(d)) {
      const float* const first = rows.first + point.first + lane;
      auto sum = hn::Mul(hn::LoadU(d, along_z + lane), SumRowsAround<kTaps>(first, rows, along_x, along_y));
      if constexpr (kTaps > kSide) {
        float last[kSide] = {};
        std::copy(along_z + kSide, along_z + kTaps, last + 2 * kSide - kTaps);
        sum = hn::MulAdd(hn::LoadU(d, last + lane),
                         SumRowsAround<kTaps>(first + kLast, rows, along_x, along_y), sum);
      }
      hn::StoreU(sum, d, sums + lane);
    }
    out[i] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
}

void InterpolatePoints(const PointWeights& weights, const SampleRows& rows,
                       std::span<const PlacedPoint> points, float* out) {
  switch (weights.taps) {
    case 4:
      return SumAtPoints<4>(weights, rows, points, out);
    case 6:
      return SumAtPoints<6>(weights, rows, points, out);
    default:
      return SumAtPoints<8>(weights, rows, points, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_INTERPOLATE_POINTS_INL
