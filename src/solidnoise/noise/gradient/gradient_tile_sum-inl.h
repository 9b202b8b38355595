// Sums of gradient noise over a tile of samples, for one instruction set. Included once per target; see
// gradient_noise_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/gradient/gradient_points-inl.h"
#include "solidnoise/noise/gradient/gradient_term-inl.h"
#include "solidnoise/noise/gradient/gradient_tile.h"

#if defined(SOLIDNOISE_GRADIENT_TILE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_GRADIENT_TILE_SUM_INL
#undef SOLIDNOISE_GRADIENT_TILE_SUM_INL
#else
#define SOLIDNOISE_GRADIENT_TILE_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {

// A vector of a group: what its points' terms have in common, whatever the slow sample.
struct GroupLane {
  int group = 0;
  int slow = 0;  // where the group begins in the rows of each role; the lane is included in the latter two
  int mid = 0;
  int fast = 0;
  float remaining = 1.0f;  // 1 - (offset along the outer role)^2
  float outer_offset = 0.0f;
};

// t and l of a point's term, but for the slow role's part.
template <int kDim>
HWY_INLINE void start_term(const TilePoints& points, const Point& point, const GroupLane& at, V& t, V& l) {
  const Tag d;
  t = hn::Set(d, at.remaining);
  l = hn::Set(d, point.outer_term);
  if constexpr (kDim >= 3) {
    const int mid = point.mid_at + at.mid;
    t = hn::Sub(t, hn::Load(d, points.mid.square + mid));
    l = hn::MulAdd(hn::Set(d, point.gradient[kMid]), hn::Load(d, points.mid.offset + mid), l);
  }
  const int fast = point.fast_at + at.fast;
  t = hn::Sub(t, hn::Load(d, points.fast.square + fast));
  l = hn::MulAdd(hn::Set(d, point.gradient[kFast]), hn::Load(d, points.fast.offset + fast), l);
}

// Adds the terms of the group's points to the values of four slow samples.
template <int kDim>
HWY_INLINE void add_values(const TilePoints& points, const GroupLane& at, V root,
                           float* HWY_RESTRICT values) {
  const Tag d;
  V value0 = hn::Load(d, values);
  V value1 = hn::Load(d, values + kLanes);
  V value2 = hn::Load(d, values + 2 * kLanes);
  V value3 = hn::Load(d, values + 3 * kLanes);
  for_each_reaching(points, at.group, [&](const Point& point) HWY_ATTR {
    V t;
    V l;
    start_term<kDim>(points, point, at, t, l);
    const float* slow_square = points.slow.square + at.slow + point.slow_at;
    const float* slow_term = point.slow_term + at.slow;
    const auto add = [&](int i, V& value) HWY_ATTR {
      const V remaining = positive_part(hn::Sub(t, hn::Set(d, slow_square[i])));
      add_term(remaining, hn::Add(l, hn::Set(d, slow_term[i])), root, value);
    };
    add(0, value0);
    add(1, value1);
    add(2, value2);
    add(3, value3);
  });
  hn::Store(value0, d, values);
  hn::Store(value1, d, values + kLanes);
  hn::Store(value2, d, values + 2 * kLanes);
  hn::Store(value3, d, values + 3 * kLanes);
}

// Values and derivatives of one vector of samples.
struct Accumulators {
  V value;
  V along[kGradientRoles];
};

HWY_INLINE Accumulators load_accumulators(const GradientTileSums& results, int at) {
  const Tag d;
  Accumulators sums;
  sums.value = hn::Load(d, results.value + at);
  for (int role = 0; role < kGradientRoles; ++role)
    sums.along[role] = hn::Load(d, results.gradient[role] + at);
  return sums;
}

HWY_INLINE void store_accumulators(const Accumulators& sums, int at, GradientTileSums& results) {
  const Tag d;
  hn::Store(sums.value, d, results.value + at);
  for (int role = 0; role < kGradientRoles; ++role)
    hn::Store(sums.along[role], d, results.gradient[role] + at);
}

// As add_values, with derivatives, for two slow samples from `first`: more would not fit the registers.
template <int kDim>
HWY_INLINE void add_derivatives(const TilePoints& points, const GroupLane& at, V root, int first, int base,
                                GradientTileSums& results) {
  const Tag d;
  Accumulators sums0 = load_accumulators(results, base);
  Accumulators sums1 = load_accumulators(results, base + kLanes);
  for_each_reaching(points, at.group, [&](const Point& point) HWY_ATTR {
    V t;
    V l;
    start_term<kDim>(points, point, at, t, l);
    const int slow = at.slow + first;
    const auto add = [&](int i, Accumulators& sums) HWY_ATTR {
      const V remaining = positive_part(hn::Sub(t, hn::Set(d, points.slow.square[point.slow_at + i])));
      const V term = hn::Add(l, hn::Set(d, point.slow_term[i]));
      const TermSlope slope = add_term_with_slope(remaining, term, root, sums.value);
      if constexpr (kDim == 4) {
        add_derivative(slope, point.gradient[kOuter], hn::Set(d, at.outer_offset), sums.along[kOuter]);
      }
      if constexpr (kDim >= 2) {
        const V offset = hn::Set(d, points.slow.offset[point.slow_at + i]);
        add_derivative(slope, point.gradient[kSlow], offset, sums.along[kSlow]);
      }
      if constexpr (kDim >= 3) {
        const V offset = hn::Load(d, points.mid.offset + point.mid_at + at.mid);
        add_derivative(slope, point.gradient[kMid], offset, sums.along[kMid]);
      }
      const V offset = hn::Load(d, points.fast.offset + point.fast_at + at.fast);
      add_derivative(slope, point.gradient[kFast], offset, sums.along[kFast]);
    };
    add(slow, sums0);
    add(slow + 1, sums1);
  });
  store_accumulators(sums0, base, results);
  store_accumulators(sums1, base + kLanes, results);
}

// Adds the terms of the gathered points to all groups.
template <int kDim, Derivatives kDerivatives>
HWY_INLINE void add_groups(const TilePoints& points, const GradientTile& tile, GroupLane at, V root,
                           GradientTileSums& results) {
  for (int slow = 0; slow < tile.groups[kSlow]; ++slow) {
    for (int mid = 0; mid < tile.groups[kMid]; ++mid) {
      for (int fast = 0; fast < tile.groups[kFast]; ++fast) {
        at.group = GradientTile::group_index(slow, mid, fast);
        at.slow = slow * kSlowSamples;
        for (int lane = 0; lane < kLanes; lane += lanes()) {
          at.mid = mid * kLanes + lane;
          at.fast = fast * kLanes + lane;
          const int base = at.group * GradientTile::kGroupSamples + lane;
          if constexpr (kDerivatives == Derivatives::none) {
            add_values<kDim>(points, at, root, results.value + base);
          } else {
            for (int first = 0; first < kSlowSamples; first += 2) {
              add_derivatives<kDim>(points, at, root, first, base + first * kLanes, results);
            }
          }
        }
      }
    }
  }
}

template <Derivatives kDerivatives>
HWY_INLINE void clear(GradientTileSums& results) {
  const Tag d;
  for (int i = 0; i < GradientTile::kSamples; i += lanes()) {
    hn::Store(hn::Zero(d), d, results.value + i);
    if constexpr (kDerivatives == Derivatives::gradient) {
      for (int role = 0; role < kGradientRoles; ++role) hn::Store(hn::Zero(d), d, results.gradient[role] + i);
    }
  }
}

template <int kDim, Derivatives kDerivatives>
void sum_terms(const GradientSum& sum, const GradientTile& tile, GradientTileSums& results) {
  TilePoints points;
  fill_rows(sum, tile, points);
  clear<kDerivatives>(results);
  for (int outer = 0; outer < tile.lattice.rows[kOuter]; ++outer) {
    GroupLane at;
    at.outer_offset = tile.outer - row_coordinate(sum, tile.lattice, kOuter, outer);
    at.remaining = 1.0f - at.outer_offset * at.outer_offset;
    if (at.remaining <= 0.0f) continue;
    gather_points(sum, tile, outer, at.outer_offset, at.remaining, points);
    add_groups<kDim, kDerivatives>(points, tile, at, hn::Set(Tag(), sum.root), results);
  }
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
