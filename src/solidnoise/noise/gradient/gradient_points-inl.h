// The lattice points that reach a tile of gradient noise and each of its groups, for one instruction set.
// Included once per target; see gradient_noise_simd.cpp.
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/gradient/gradient_term-inl.h"
#include "solidnoise/noise/gradient/gradient_tile.h"

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
constexpr int kWords = (kMaxPoints + 63) / 64;

// Offsets of a tile's samples from the rows of lattice points along one role, and their squares: per row, two
// groups of kSamples.
template <int kSamples>
struct alignas(64) TileRows {
  static constexpr int kStride = 2 * kSamples;

  float offset[kMaxRows * kStride];
  float square[kMaxRows * kStride];
  // Per row, the least squared offset of any sample of the 8 groups of the tile, each its own lane: never
  // more than any sample's, to the last bit, because rounding is monotone.
  float reach[kMaxRows * kGroups];
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
  alignas(64) std::uint8_t groups[kWords * 64];  // per point, a bit for each group that it reaches
  std::uint64_t reaching[kGroups][kWords];       // the same per group, a bit for each point
};

// Square of the distance of a row from the interval between two samples.
HWY_INLINE float squared_gap(float row, float lower, float upper) {
  const float below = lower - row;
  const float above = row - upper;
  float gap = below > above ? below : above;
  gap = gap > 0.0f ? gap : 0.0f;
  return gap * gap;
}

// The bit of a group's index that says which of the role's two groups it is in.
constexpr int group_bit(GradientRole role) {
  if (role == kSlow) return GradientTile::group_index(1, 0, 0);
  return role == kMid ? GradientTile::group_index(0, 1, 0) : GradientTile::group_index(0, 0, 1);
}

// `samples`: two groups of kSamples, in ascending order but for the order of the lanes of a group.
template <int kSamples>
HWY_INLINE void fill_rows(const GradientSum& sum, const GradientTile& tile, GradientRole role,
                          const float* samples, TileRows<kSamples>& rows) {
  const hn::CappedTag<float, kSamples> d;
  const int groups = tile.groups[role];
  for (int row = 0; row < tile.lattice.rows[role]; ++row) {
    const float coordinate = row_coordinate(sum, tile.lattice, role, row);
    for (int i = 0; i < groups * kSamples; i += static_cast<int>(hn::Lanes(d))) {
      const auto offset = hn::Sub(hn::Load(d, samples + i), hn::Set(d, coordinate));
      hn::Store(offset, d, rows.offset + row * rows.kStride + i);
      hn::Store(hn::Mul(offset, offset), d, rows.square + row * rows.kStride + i);
    }
    // A role with one group has it in the place of the second as well.
    const float near = squared_gap(coordinate, samples[0], samples[kSamples - 1]);
    const float* second = samples + (groups - 1) * kSamples;
    const float far = squared_gap(coordinate, second[0], second[kSamples - 1]);
    for (int group = 0; group < kGroups; ++group) {
      rows.reach[row * kGroups + group] = (group & group_bit(role)) != 0 ? far : near;
    }
  }
}

HWY_INLINE void fill_rows(const GradientSum& sum, const GradientTile& tile, TilePoints& points) {
  fill_rows(sum, tile, kSlow, tile.slow[0], points.slow);
  fill_rows(sum, tile, kMid, tile.mid[0], points.mid);
  fill_rows(sum, tile, kFast, tile.fast[0], points.fast);
}

// The lanes of a mask as bits, lane 0 the lowest.
template <class D>
HWY_INLINE std::uint64_t mask_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  const std::size_t count = hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) bits |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return bits;
}

// Lists the places of the lattice points that reach any group, in lexicographic order. `remaining` is
// 1 - (offset along the outer role)^2.
HWY_INLINE void find_places(const GradientTile& tile, float remaining, TilePoints& points) {
  const hn::CappedTag<float, kGroups> d;
  const int step = static_cast<int>(hn::Lanes(d));
  int count = 0;
  for (int slow = 0; slow < tile.lattice.rows[kSlow]; ++slow) {
    for (int mid = 0; mid < tile.lattice.rows[kMid]; ++mid) {
      for (int fast = 0; fast < tile.lattice.rows[kFast]; ++fast) {
        // In the order of operations of the sum: upper bounds of the t of each group's samples.
        unsigned groups = 0;
        for (int group = 0; group < kGroups; group += step) {
          auto t = hn::Sub(hn::Set(d, remaining), hn::Load(d, points.mid.reach + mid * kGroups + group));
          t = hn::Sub(t, hn::Load(d, points.fast.reach + fast * kGroups + group));
          t = hn::Sub(t, hn::Load(d, points.slow.reach + slow * kGroups + group));
          groups |= static_cast<unsigned>(mask_bits(d, hn::Gt(t, hn::Zero(d)))) << group;
        }
        points.places[count] = {static_cast<std::int16_t>(slow), static_cast<std::int16_t>(mid),
                                static_cast<std::int16_t>(fast), 0};
        points.groups[count] = static_cast<std::uint8_t>(groups);
        count += groups != 0 ? 1 : 0;
      }
    }
  }
  points.count = count;
}

// Turns the groups of each point into the points of each group.
HWY_INLINE void list_groups(TilePoints& points) {
  const hn::CappedTag<std::uint8_t, 64> d;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int word = 0; word * 64 < points.count; ++word) {
    const int left = points.count - word * 64;
    const std::uint64_t valid = left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
    for (int group = 0; group < kGroups; ++group) {
      const auto bit = hn::Set(d, static_cast<std::uint8_t>(1u << group));
      std::uint64_t bits = 0;
      for (int i = 0; i < 64; i += step) {
        const auto groups = hn::Load(d, points.groups + word * 64 + i);
        bits |= mask_bits(d, hn::TestBit(groups, bit)) << i;
      }
      points.reaching[group][word] = bits & valid;
    }
  }
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
  }
  list_groups(points);
}

// Calls `visit` with each gathered point that reaches a group, in order.
template <typename Visit>
HWY_INLINE void for_each_reaching(const TilePoints& points, int group, const Visit& visit) {
  for (int word = 0; word * 64 < points.count; ++word) {
    for (std::uint64_t bits = points.reaching[group][word]; bits != 0; bits &= bits - 1) {
      visit(points.points[word * 64 + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits))]);
    }
  }
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
