// Interpolation along one axis, for one instruction set. Included once per target; see
// interpolate_axis_simd.cpp.
#include <algorithm>
#include <cstddef>
#include <type_traits>

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

// One row out of each outer array, of the values that fill whole vectors of D: what `combine(rows, i)` makes
// of the values from i on of the rows that begin at `rows`. Returns how many of a row these are.
template <class D, class Combine>
HWY_INLINE std::size_t CombineRows(D d, const AxisShape& shape, std::size_t out_stride, std::size_t begin,
                                   const float* in, float* out, const Combine& combine) {
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t end = begin + (shape.inner - begin) / lanes * lanes;
  for (std::size_t o = 0; o < shape.outer; ++o) {
    const float* const rows = in + o * shape.in * shape.inner;
    float* const to = out + o * out_stride;
    for (std::size_t i = begin; i < end; i += lanes) hn::StoreU(combine(rows, i), d, to + i);
  }
  return end;
}

// The same, of weighted rows; `weight` of kTaps.
template <int kTaps, class D>
HWY_INLINE std::size_t SumRows(D d, const float* weight, const AxisShape& shape, std::size_t out_stride,
                               std::size_t begin, const float* in, float* out) {
  using V = hn::Vec<D>;
  const auto weight_of = [&](int tap) HWY_ATTR { return hn::Set(d, tap < kTaps ? weight[tap] : 0.0f); };
  const V w0 = weight_of(0);
  const V w1 = weight_of(1);
  const V w2 = weight_of(2);
  const V w3 = weight_of(3);
  const V w4 = weight_of(4);
  const V w5 = weight_of(5);
  const V w6 = weight_of(6);
  const V w7 = weight_of(7);
  return CombineRows(d, shape, out_stride, begin, in, out, [&](const float* rows, std::size_t i) HWY_ATTR {
    const auto row = [&](std::size_t tap) HWY_ATTR { return hn::LoadU(d, rows + tap * shape.inner + i); };
    V sum = hn::Mul(w0, row(0));
    if constexpr (kTaps >= 4) {
      sum = hn::MulAdd(w1, row(1), sum);
      sum = hn::MulAdd(w2, row(2), sum);
      sum = hn::MulAdd(w3, row(3), sum);
    }
    if constexpr (kTaps >= 6) {
      sum = hn::MulAdd(w4, row(4), sum);
      sum = hn::MulAdd(w5, row(5), sum);
    }
    if constexpr (kTaps >= 8) {
      sum = hn::MulAdd(w6, row(6), sum);
      sum = hn::MulAdd(w7, row(7), sum);
    }
    return sum;
  });
}

// Along an axis whose rows are long: each row is a row of the coarse ones, or a sum of them.
template <int kTaps>
HWY_INLINE void InterpolateRows(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out) {
  const std::size_t stride = axis.count() * shape.inner;
  const auto interpolate = [&](auto d, std::size_t begin) HWY_ATTR {
    if (shape.inner - begin < hn::Lanes(d)) return begin;
    std::size_t end = begin;
    for (std::size_t i = 0; i < axis.count(); ++i) {
      const float* const from = in + axis.first(i) * shape.inner;
      float* const to = out + i * shape.inner;
      if (const int copied = axis.copied(i); copied >= 0) {
        const std::size_t row = static_cast<std::size_t>(copied) * shape.inner;
        end = CombineRows(d, shape, stride, begin, from, to, [&](const float* rows, std::size_t k) HWY_ATTR {
          return hn::LoadU(d, rows + row + k);
        });
      } else {
        end = SumRows<kTaps>(d, axis.weights(i), shape, stride, begin, from, to);
      }
    }
    return end;
  };
  std::size_t done = interpolate(hn::ScalableTag<float>(), 0);
  done = interpolate(hn::CappedTag<float, 8>(), done);
  interpolate(hn::CappedTag<float, 1>(), done);
}

void InterpolateAxis(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out) {
  switch (axis.taps()) {
    case 1:
      return InterpolateRows<1>(axis, shape, in, out);
    case 4:
      return InterpolateRows<4>(axis, shape, in, out);
    case 6:
      return InterpolateRows<6>(axis, shape, in, out);
    default:
      return InterpolateRows<8>(axis, shape, in, out);
  }
}

// One tile of kRows rows, whose sums do not wait for each other.
template <int kRows, class D>
HWY_INLINE void SumTiles(D d, const AxisTaps::Tile& tile, const float* from, std::size_t from_stride,
                         float* to, std::size_t to_stride) {
  using V = hn::Vec<D>;
  const std::size_t columns = tile.columns.size();
  for (std::size_t lane = 0; lane < AxisTaps::Tile::kSide; lane += hn::Lanes(d)) {
    V sum0 = hn::Zero(d);
    V sum1 = hn::Zero(d);
    V sum2 = hn::Zero(d);
    V sum3 = hn::Zero(d);
    for (std::size_t k = 0; k < columns; ++k) {
      const V column = hn::LoadU(d, tile.columns[k].data() + lane);
      sum0 = hn::MulAdd(hn::Set(d, from[k]), column, sum0);
      if constexpr (kRows > 1) sum1 = hn::MulAdd(hn::Set(d, from[from_stride + k]), column, sum1);
      if constexpr (kRows > 2) sum2 = hn::MulAdd(hn::Set(d, from[2 * from_stride + k]), column, sum2);
      if constexpr (kRows > 3) sum3 = hn::MulAdd(hn::Set(d, from[3 * from_stride + k]), column, sum3);
    }
    hn::StoreU(sum0, d, to + lane);
    if constexpr (kRows > 1) hn::StoreU(sum1, d, to + to_stride + lane);
    if constexpr (kRows > 2) hn::StoreU(sum2, d, to + 2 * to_stride + lane);
    if constexpr (kRows > 3) hn::StoreU(sum3, d, to + 3 * to_stride + lane);
  }
}

// Along the last axis: tile by tile, for all rows.
void InterpolateLastAxis(const AxisTaps& axis, const SampleRows& rows, float* out) {
  constexpr std::size_t kSide = AxisTaps::Tile::kSide;
  const hn::CappedTag<float, kSide> d;
  for (const AxisTaps::Tile& tile : axis.tiles()) {
    for (std::size_t slab = 0; slab < rows.slabs; ++slab) {
      const float* from = rows.first + slab * rows.slab_stride + tile.first;
      float* to = out + slab * rows.rows * axis.count() + tile.begin;
      std::size_t row = 0;
      const auto next = [&](auto count) HWY_ATTR {
        SumTiles<count>(d, tile, from + row * rows.row_stride, rows.row_stride, to + row * axis.count(),
                        axis.count());
        row += count;
      };
      if (tile.count < kSide) {
        for (; row < rows.rows; ++row) {
          float sums[kSide];
          SumTiles<1>(d, tile, from + row * rows.row_stride, 0, sums, 0);
          std::copy_n(sums, tile.count, to + row * axis.count());
        }
        continue;
      }
      while (row + 4 <= rows.rows) next(std::integral_constant<int, 4>());
      if (row + 3 == rows.rows) next(std::integral_constant<int, 3>());
      if (row + 2 == rows.rows) next(std::integral_constant<int, 2>());
      if (row + 1 == rows.rows) next(std::integral_constant<int, 1>());
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_INTERPOLATE_AXIS_INL
