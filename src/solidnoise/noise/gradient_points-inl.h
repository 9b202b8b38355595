// The lattice points that reach a tile of gradient noise and each of its groups, for one instruction set.
// Included once per target; see gradient_noise_simd.cpp.
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/gradient_term-inl.h"
#include "solidnoise/noise/gradient_tile.h"

#if defined(SOLIDNOISE_GRADIENT_POINTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_GRADIENT_POINTS_INL
#undef SOLIDNOISE_GRADIENT_POINTS_INL
#else
#define SOLIDNOISE_GRADIENT_POINTS_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {

constexpr int kGroups = 8;
constexpr int kLanes = GradientTile::kLanes;
constexpr int kSlowSamples = GradientTile::kSlow;
constexpr int kMaxRows = GradientTile::kMaxRows;
constexpr int kMaxPoints = kMaxRows * kMaxRows * kMaxRows;

// Offsets of a tile's samples from the rows of lattice points along one role, and their squares: per row, two
// groups of kSamples.
template <int kSamples>
struct alignas(64) TileRows {
  static constexpr int kStride = 2 * kSamples;

  float offset[kMaxRows * kStride];
  float square[kMaxRows * kStride];
  // The least squared offset of each group, and of the tile: never more than any sample's, to the last bit,
  // because rounding is monotone.
  float group_reach[kMaxRows][2];
  float tile_reach[kMaxRows];
};

// One lattice point that reaches the tile.
struct alignas(64) Point {
  float gradient[kGradientRoles];
  float outer_term;                       // gradient times offset along the outer role
  std::int32_t slow_at, mid_at, fast_at;  // where its rows begin in TileRows
  float slow_term[2 * kSlowSamples];      // gradient times offset along the slow role
};

// A tile's rows, and its lattice points of one outer row.
struct TilePoints {
  TileRows<kSlowSamples> slow;
  TileRows<kLanes> mid;
  TileRows<kLanes> fast;

  int count;
  Point points[kMaxPoints];
  struct Place {
    std::int16_t slow, mid, fast, unused;
  };
  Place places[kMaxPoints + 1];

  // The points' least squared offsets from each group, per role.
  alignas(64) float slow_reach[2][kMaxPoints + kLanes];
  alignas(64) float mid_reach[2][kMaxPoints + kLanes];
  alignas(64) float fast_reach[2][kMaxPoints + kLanes];

  // Per group, the points that reach it: from begin[group] to end[group].
  int begin[kGroups];
  int end[kGroups];
  std::int32_t reaching[kGroups * kMaxPoints + kLanes];
};

// Square of the distance of a row from the interval between two samples.
HWY_INLINE float squared_gap(float row, float lower, float upper) {
  const float below = lower - row;
  const float above = row - upper;
  float gap = below > above ? below : above;
  gap = gap > 0.0f ? gap : 0.0f;
  return gap * gap;
}

// `samples`: two groups of kSamples, in ascending order but for the order of the lanes of a group.
template <int kSamples>
HWY_INLINE void fill_rows(const GradientSum& sum, const GradientTile& tile, GradientRole role,
                          const float* samples, TileRows<kSamples>& rows) {
  const hn::CappedTag<float, kSamples> d;
  const int groups = tile.groups[role];
  const int last = kSamples - 1;
  for (int row = 0; row < tile.lattice.rows[role]; ++row) {
    const float coordinate = row_coordinate(sum, tile.lattice, role, row);
    for (int i = 0; i < groups * kSamples; i += static_cast<int>(hn::Lanes(d))) {
      const auto offset = hn::Sub(hn::Load(d, samples + i), hn::Set(d, coordinate));
      hn::Store(offset, d, rows.offset + row * rows.kStride + i);
      hn::Store(hn::Mul(offset, offset), d, rows.square + row * rows.kStride + i);
    }
    for (int group = 0; group < groups; ++group) {
      const float* first = samples + group * kSamples;
      rows.group_reach[row][group] = squared_gap(coordinate, first[0], first[last]);
    }
    rows.tile_reach[row] = squared_gap(coordinate, samples[0], samples[groups * kSamples - 1]);
  }
}

HWY_INLINE void fill_rows(const GradientSum& sum, const GradientTile& tile, TilePoints& points) {
  fill_rows(sum, tile, kSlow, tile.slow[0], points.slow);
  fill_rows(sum, tile, kMid, tile.mid[0], points.mid);
  fill_rows(sum, tile, kFast, tile.fast[0], points.fast);
}

// Lists the places of the lattice points that reach the tile, in lexicographic order. `remaining` is
// 1 - (offset along the outer role)^2.
HWY_INLINE void find_places(const GradientTile& tile, float remaining, TilePoints& points) {
  int count = 0;
  for (int slow = 0; slow < tile.lattice.rows[kSlow]; ++slow) {
    const float slow_reach = points.slow.tile_reach[slow];
    for (int mid = 0; mid < tile.lattice.rows[kMid]; ++mid) {
      const float rest = remaining - points.mid.tile_reach[mid];
      for (int fast = 0; fast < tile.lattice.rows[kFast]; ++fast) {
        points.places[count] = {static_cast<std::int16_t>(slow), static_cast<std::int16_t>(mid),
                                static_cast<std::int16_t>(fast), 0};
        // In the order of operations of the sum: an upper bound of every sample's t.
        const float t = (rest - points.fast.tile_reach[fast]) - slow_reach;
        count += t > 0.0f ? 1 : 0;
      }
    }
  }
  points.count = count;
}

// Gathers the lattice points of one outer row that reach the tile.
HWY_INLINE void gather_points(const GradientSum& sum, const GradientTile& tile, int outer_row,
                              float outer_offset, float remaining, TilePoints& points) {
  find_places(tile, remaining, points);
  const GradientRows& lattice = tile.lattice;
  const std::uint8_t* indices = lattice.gradient_index + outer_row * lattice.stride[kOuter];
  for (int i = 0; i < points.count; ++i) {
    const TilePoints::Place place = points.places[i];
    Point& point = points.points[i];
    const int index = place.slow * lattice.stride[kSlow] + place.mid * lattice.stride[kMid] +
                      place.fast * lattice.stride[kFast];
    const float* gradient = sum.gradients[indices[index]];
    for (int role = 0; role < kGradientRoles; ++role) point.gradient[role] = gradient[role];
    point.outer_term = gradient[kOuter] * outer_offset;
    point.slow_at = place.slow * points.slow.kStride;
    point.mid_at = place.mid * points.mid.kStride;
    point.fast_at = place.fast * points.fast.kStride;
    for (int k = 0; k < 2 * kSlowSamples; ++k) {
      point.slow_term[k] = gradient[kSlow] * points.slow.offset[point.slow_at + k];
    }
    for (int group = 0; group < 2; ++group) {
      points.slow_reach[group][i] = points.slow.group_reach[place.slow][group];
      points.mid_reach[group][i] = points.mid.group_reach[place.mid][group];
      points.fast_reach[group][i] = points.fast.group_reach[place.fast][group];
    }
  }
}

// Lists the points that reach a group.
HWY_INLINE int cull_points(float remaining, int slow, int mid, int fast, int begin, TilePoints& points) {
  const Tag d;
  const IndexTag di;
  int end = begin;
  for (int i = 0; i < points.count; i += lanes()) {
    V t = hn::Sub(hn::Set(d, remaining), hn::Load(d, points.mid_reach[mid] + i));
    t = hn::Sub(t, hn::Load(d, points.fast_reach[fast] + i));
    t = hn::Sub(t, hn::Load(d, points.slow_reach[slow] + i));
    const auto valid = hn::FirstN(d, static_cast<std::size_t>(points.count - i));
    const auto reaches = hn::And(hn::Gt(t, hn::Zero(d)), valid);
    const auto indices = hn::Compress(hn::Iota(di, i), hn::RebindMask(di, reaches));
    hn::StoreU(indices, di, points.reaching + end);
    end += static_cast<int>(hn::CountTrue(d, reaches));
  }
  return end;
}

HWY_INLINE void cull_points(const GradientTile& tile, float remaining, TilePoints& points) {
  int end = 0;
  for (int slow = 0; slow < tile.groups[kSlow]; ++slow) {
    for (int mid = 0; mid < tile.groups[kMid]; ++mid) {
      for (int fast = 0; fast < tile.groups[kFast]; ++fast) {
        const int group = GradientTile::group_index(slow, mid, fast);
        points.begin[group] = end;
        end = cull_points(remaining, slow, mid, fast, end, points);
        points.end[group] = end;
      }
    }
  }
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
