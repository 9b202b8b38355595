// Sums of gradient noise, for one instruction set. Included once per target; see gradient_noise_simd.cpp.
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/gradient_tile.h"

#if defined(SOLIDNOISE_GRADIENT_NOISE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_GRADIENT_NOISE_INL
#undef SOLIDNOISE_GRADIENT_NOISE_INL
#else
#define SOLIDNOISE_GRADIENT_NOISE_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, GradientTile::kLanes>;
using IndexTag = hn::RebindToSigned<Tag>;
using V = hn::Vec<Tag>;

constexpr int kLanes = GradientTile::kLanes;
constexpr int kSlowSamples = GradientTile::kSlow;
constexpr int kMaxRows = GradientTile::kMaxRows;
constexpr int kMaxPoints = kMaxRows * kMaxRows * kMaxRows;

// Adds a lattice point's term t^4 (t - root) l to the value.
HWY_INLINE void add_value(V t, V l, V root, V& value) {
  const V t2 = hn::Mul(t, t);
  const V t4 = hn::Mul(t2, t2);
  value = hn::MulAdd(hn::Mul(t4, l), hn::Sub(t, root), value);
}

// The same, to the bit, and the factors of the derivative along each axis: the derivative of the term is
//   along_gradient * gradient + along_offset * offset,
// with s = t^4 (t - root) and -2 l ds/dt = -2 l t^3 (5 t - 4 root).
HWY_INLINE void add_value(V t, V l, V root, V& value, V& along_gradient, V& along_offset) {
  const Tag d;
  const V t2 = hn::Mul(t, t);
  const V t4 = hn::Mul(t2, t2);
  const V factor = hn::Sub(t, root);
  value = hn::MulAdd(hn::Mul(t4, l), factor, value);
  along_gradient = hn::Mul(t4, factor);
  const V slope = hn::MulAdd(hn::Set(d, -10.0f), t, hn::Mul(hn::Set(d, 8.0f), root));
  along_offset = hn::Mul(hn::Mul(hn::Mul(t2, t), l), slope);
}

// Offsets of the samples from the rows of lattice points, and their squares.
struct SlowRows {
  float offset[kMaxRows][2][kSlowSamples];
  float square[kMaxRows][2][kSlowSamples];
};
struct LaneRows {
  alignas(64) float offset[kMaxRows][2][kLanes];
  alignas(64) float square[kMaxRows][2][kLanes];
};

// The least squared offset of each group, and of the tile, from each row: never more than any sample's, to
// the last bit, because rounding is monotone.
struct RowReach {
  float group[kMaxRows][2];
  float tile[kMaxRows];
};

// One lattice point that reaches the tile.
struct alignas(64) Point {
  float gradient[kGradientRoles];
  float outer_term;  // gradient times offset along the outer role
  std::int16_t slow, mid, fast, unused;
  float slow_term[2][kSlowSamples];  // gradient times offset along the slow role
};

// Everything about a tile that does not depend on the group.
struct TileWork {
  SlowRows slow;
  LaneRows mid;
  LaneRows fast;
  RowReach slow_reach;
  RowReach mid_reach;
  RowReach fast_reach;
  int count;  // of points
  Point points[kMaxPoints];
  // The points' least squared offsets from each group, per role.
  alignas(64) float slow_cull[2][kMaxPoints + kLanes];
  alignas(64) float mid_cull[2][kMaxPoints + kLanes];
  alignas(64) float fast_cull[2][kMaxPoints + kLanes];
  std::int32_t reaching[kMaxPoints + kLanes];
};

HWY_INLINE float row_coordinate(const GradientSum& sum, const GradientRows& lattice, int role, int row) {
  return lattice.first[role] + sum.spacing * static_cast<float>(row);
}

// Square of the distance of a row from the interval between two samples.
HWY_INLINE float squared_gap(float row, float lower, float upper) {
  const float below = lower - row;
  const float above = row - upper;
  float gap = below > above ? below : above;
  gap = gap > 0.0f ? gap : 0.0f;
  return gap * gap;
}

HWY_INLINE void fill_reach(const GradientSum& sum, const GradientTile& tile, GradientRole role,
                           const float* samples, int samples_per_group, RowReach& reach) {
  const int last_group = tile.groups[role] - 1;
  const int last = samples_per_group - 1;
  for (int row = 0; row < tile.lattice.rows[role]; ++row) {
    const float coordinate = row_coordinate(sum, tile.lattice, role, row);
    for (int group = 0; group <= last_group; ++group) {
      const float* first = samples + group * samples_per_group;
      reach.group[row][group] = squared_gap(coordinate, first[0], first[last]);
    }
    reach.tile[row] = squared_gap(coordinate, samples[0], samples[last_group * samples_per_group + last]);
  }
}

HWY_INLINE void fill_slow_rows(const GradientSum& sum, const GradientTile& tile, SlowRows& rows) {
  for (int row = 0; row < tile.lattice.rows[kSlow]; ++row) {
    const float coordinate = row_coordinate(sum, tile.lattice, kSlow, row);
    for (int group = 0; group < tile.groups[kSlow]; ++group) {
      for (int i = 0; i < kSlowSamples; ++i) {
        const float offset = tile.slow[group][i] - coordinate;
        rows.offset[row][group][i] = offset;
        rows.square[row][group][i] = offset * offset;
      }
    }
  }
}

HWY_INLINE void fill_lane_rows(const GradientSum& sum, const GradientTile& tile, GradientRole role,
                               const float (*samples)[kLanes], LaneRows& rows) {
  const Tag d;
  for (int row = 0; row < tile.lattice.rows[role]; ++row) {
    const V coordinate = hn::Set(d, row_coordinate(sum, tile.lattice, role, row));
    for (int group = 0; group < tile.groups[role]; ++group) {
      for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
        const V offset = hn::Sub(hn::Load(d, samples[group] + lane), coordinate);
        hn::Store(offset, d, rows.offset[row][group] + lane);
        hn::Store(hn::Mul(offset, offset), d, rows.square[row][group] + lane);
      }
    }
  }
}

// Gathers the lattice points of one outer row that reach the tile, in lexicographic order. `remaining` is
// 1 - (offset along the outer role)^2.
HWY_INLINE void gather_points(const GradientSum& sum, const GradientTile& tile, int outer_row,
                              float outer_offset, float remaining, TileWork& work) {
  const GradientRows& lattice = tile.lattice;
  int count = 0;
  for (int slow = 0; slow < lattice.rows[kSlow]; ++slow) {
    for (int mid = 0; mid < lattice.rows[kMid]; ++mid) {
      const float rest = remaining - work.mid_reach.tile[mid];
      for (int fast = 0; fast < lattice.rows[kFast]; ++fast) {
        Point& point = work.points[count];
        point.slow = static_cast<std::int16_t>(slow);
        point.mid = static_cast<std::int16_t>(mid);
        point.fast = static_cast<std::int16_t>(fast);
        // In the order of operations of the sum: an upper bound of every sample's t.
        const float t = (rest - work.fast_reach.tile[fast]) - work.slow_reach.tile[slow];
        count += t > 0.0f ? 1 : 0;
      }
    }
  }
  work.count = count;

  const std::uint8_t* indices = lattice.gradient_index + outer_row * lattice.stride[kOuter];
  for (int i = 0; i < count; ++i) {
    Point& point = work.points[i];
    const int index = point.slow * lattice.stride[kSlow] + point.mid * lattice.stride[kMid] +
                      point.fast * lattice.stride[kFast];
    const float* gradient = sum.gradients[indices[index]];
    for (int role = 0; role < kGradientRoles; ++role) point.gradient[role] = gradient[role];
    point.outer_term = gradient[kOuter] * outer_offset;
    for (int group = 0; group < 2; ++group) {
      for (int k = 0; k < kSlowSamples; ++k) {
        point.slow_term[group][k] = gradient[kSlow] * work.slow.offset[point.slow][group][k];
      }
      work.slow_cull[group][i] = work.slow_reach.group[point.slow][group];
      work.mid_cull[group][i] = work.mid_reach.group[point.mid][group];
      work.fast_cull[group][i] = work.fast_reach.group[point.fast][group];
    }
  }
}

// Lists the points that reach a group; returns how many.
HWY_INLINE int cull_points(float remaining, int slow, int mid, int fast, TileWork& work) {
  const Tag d;
  const IndexTag di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int listed = 0;
  for (int i = 0; i < work.count; i += lanes) {
    V t = hn::Sub(hn::Set(d, remaining), hn::Load(d, work.mid_cull[mid] + i));
    t = hn::Sub(t, hn::Load(d, work.fast_cull[fast] + i));
    t = hn::Sub(t, hn::Load(d, work.slow_cull[slow] + i));
    const auto valid = hn::FirstN(d, static_cast<std::size_t>(work.count - i));
    const auto reaches = hn::And(hn::Gt(t, hn::Zero(d)), valid);
    const auto indices = hn::Compress(hn::Iota(di, i), hn::RebindMask(di, reaches));
    hn::StoreU(indices, di, work.reaching + listed);
    listed += static_cast<int>(hn::CountTrue(d, reaches));
  }
  return listed;
}

template <int kDim>
HWY_INLINE void sum_values(const TileWork& work, int listed, float remaining, V root, int slow, int mid,
                           int fast, float* HWY_RESTRICT values) {
  const Tag d;
  const V zero = hn::Zero(d);
  const V start = hn::Set(d, remaining);
  for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
    V value0 = hn::Load(d, values + lane);
    V value1 = hn::Load(d, values + kLanes + lane);
    V value2 = hn::Load(d, values + 2 * kLanes + lane);
    V value3 = hn::Load(d, values + 3 * kLanes + lane);
    for (int k = 0; k < listed; ++k) {
      const Point& point = work.points[work.reaching[k]];
      V t = start;
      V l = hn::Set(d, point.outer_term);
      if constexpr (kDim >= 3) {
        t = hn::Sub(t, hn::Load(d, work.mid.square[point.mid][mid] + lane));
        l = hn::MulAdd(hn::Set(d, point.gradient[kMid]), hn::Load(d, work.mid.offset[point.mid][mid] + lane),
                       l);
      }
      t = hn::Sub(t, hn::Load(d, work.fast.square[point.fast][fast] + lane));
      l = hn::MulAdd(hn::Set(d, point.gradient[kFast]),
                     hn::Load(d, work.fast.offset[point.fast][fast] + lane), l);
      const float* slow_square = work.slow.square[point.slow][slow];
      const float* slow_term = point.slow_term[slow];
      const auto add = [&](int i, V& value) HWY_ATTR {
        const V ti = hn::Max(hn::Sub(t, hn::Set(d, slow_square[i])), zero);
        add_value(ti, hn::Add(l, hn::Set(d, slow_term[i])), root, value);
      };
      add(0, value0);
      add(1, value1);
      add(2, value2);
      add(3, value3);
    }
    hn::Store(value0, d, values + lane);
    hn::Store(value1, d, values + kLanes + lane);
    hn::Store(value2, d, values + 2 * kLanes + lane);
    hn::Store(value3, d, values + 3 * kLanes + lane);
  }
}

// As sum_values, with derivatives, for one slow sample at a time: more would not fit the registers.
template <int kDim>
HWY_INLINE void sum_derivatives(const TileWork& work, int listed, float outer_offset, float remaining, V root,
                                int slow, int mid, int fast, int base, GradientTileResults& results) {
  const Tag d;
  const V zero = hn::Zero(d);
  for (int i = 0; i < kSlowSamples; ++i) {
    for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
      const int at = base + i * kLanes + lane;
      V value = hn::Load(d, results.value + at);
      V along[kGradientRoles];
      for (int role = 0; role < kGradientRoles; ++role)
        along[role] = hn::Load(d, results.derivative[role] + at);
      for (int k = 0; k < listed; ++k) {
        const Point& point = work.points[work.reaching[k]];
        V t = hn::Set(d, remaining);
        V l = hn::Set(d, point.outer_term);
        const V mid_offset = hn::Load(d, work.mid.offset[point.mid][mid] + lane);
        const V fast_offset = hn::Load(d, work.fast.offset[point.fast][fast] + lane);
        if constexpr (kDim >= 3) {
          t = hn::Sub(t, hn::Load(d, work.mid.square[point.mid][mid] + lane));
          l = hn::MulAdd(hn::Set(d, point.gradient[kMid]), mid_offset, l);
        }
        t = hn::Sub(t, hn::Load(d, work.fast.square[point.fast][fast] + lane));
        l = hn::MulAdd(hn::Set(d, point.gradient[kFast]), fast_offset, l);
        t = hn::Max(hn::Sub(t, hn::Set(d, work.slow.square[point.slow][slow][i])), zero);
        l = hn::Add(l, hn::Set(d, point.slow_term[slow][i]));
        V along_gradient;
        V along_offset;
        add_value(t, l, root, value, along_gradient, along_offset);
        const auto add = [&](GradientRole role, V offset) HWY_ATTR {
          along[role] = hn::MulAdd(along_gradient, hn::Set(d, point.gradient[role]), along[role]);
          along[role] = hn::MulAdd(along_offset, offset, along[role]);
        };
        if constexpr (kDim == 4) add(kOuter, hn::Set(d, outer_offset));
        if constexpr (kDim >= 2) add(kSlow, hn::Set(d, work.slow.offset[point.slow][slow][i]));
        if constexpr (kDim >= 3) add(kMid, mid_offset);
        add(kFast, fast_offset);
      }
      hn::Store(value, d, results.value + at);
      for (int role = 0; role < kGradientRoles; ++role)
        hn::Store(along[role], d, results.derivative[role] + at);
    }
  }
}

HWY_INLINE void clear(float* values, int count) {
  const Tag d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) hn::Store(hn::Zero(d), d, values + i);
}

template <int kDim, GradientOutput kOutput>
void sum_tile(const GradientSum& sum, const GradientTile& tile, GradientTileResults& results) {
  TileWork work;
  fill_slow_rows(sum, tile, work.slow);
  fill_lane_rows(sum, tile, kMid, tile.mid, work.mid);
  fill_lane_rows(sum, tile, kFast, tile.fast, work.fast);
  fill_reach(sum, tile, kSlow, tile.slow[0], kSlowSamples, work.slow_reach);
  fill_reach(sum, tile, kMid, tile.mid[0], kLanes, work.mid_reach);
  fill_reach(sum, tile, kFast, tile.fast[0], kLanes, work.fast_reach);
  clear(results.value, GradientTile::kSamples);
  if constexpr (kOutput == GradientOutput::value_and_derivative) {
    for (float* derivative :
         {results.derivative[0], results.derivative[1], results.derivative[2], results.derivative[3]}) {
      clear(derivative, GradientTile::kSamples);
    }
  }

  const V root = hn::Set(Tag(), sum.root);
  for (int outer = 0; outer < tile.lattice.rows[kOuter]; ++outer) {
    const float outer_offset = tile.outer - row_coordinate(sum, tile.lattice, kOuter, outer);
    const float remaining = 1.0f - outer_offset * outer_offset;
    if (remaining <= 0.0f) continue;
    gather_points(sum, tile, outer, outer_offset, remaining, work);
    for (int slow = 0; slow < tile.groups[kSlow]; ++slow) {
      for (int mid = 0; mid < tile.groups[kMid]; ++mid) {
        for (int fast = 0; fast < tile.groups[kFast]; ++fast) {
          const int listed = cull_points(remaining, slow, mid, fast, work);
          const int base = GradientTile::group_index(slow, mid, fast) * GradientTile::kGroupSamples;
          if constexpr (kOutput == GradientOutput::value) {
            sum_values<kDim>(work, listed, remaining, root, slow, mid, fast, results.value + base);
          } else {
            sum_derivatives<kDim>(work, listed, outer_offset, remaining, root, slow, mid, fast, base,
                                  results);
          }
        }
      }
    }
  }
}

template <int kDim, GradientOutput kOutput>
void sum_cluster(const GradientSum& sum, const GradientCluster& cluster, GradientClusterResults& results) {
  const Tag d;
  const V zero = hn::Zero(d);
  const V root = hn::Set(d, sum.root);
  const GradientRows& lattice = cluster.lattice;
  for (int lane = 0; lane < cluster.count; lane += static_cast<int>(hn::Lanes(d))) {
    const auto offset_from = [&](GradientRole role, int row) HWY_ATTR {
      return hn::Sub(hn::Load(d, cluster.position[role] + lane),
                     hn::Set(d, row_coordinate(sum, lattice, role, row)));
    };
    V value = zero;
    V along[kGradientRoles] = {zero, zero, zero, zero};
    for (int outer = 0; outer < lattice.rows[kOuter]; ++outer) {
      const V outer_offset = offset_from(kOuter, outer);
      const V outer_rest = hn::Sub(hn::Set(d, 1.0f), hn::Mul(outer_offset, outer_offset));
      for (int slow = 0; slow < lattice.rows[kSlow]; ++slow) {
        const V slow_offset = offset_from(kSlow, slow);
        const V slow_square = hn::Mul(slow_offset, slow_offset);
        for (int mid = 0; mid < lattice.rows[kMid]; ++mid) {
          const V mid_offset = offset_from(kMid, mid);
          const V mid_rest = hn::Sub(outer_rest, hn::Mul(mid_offset, mid_offset));
          const std::uint8_t* indices = lattice.gradient_index + outer * lattice.stride[kOuter] +
                                        slow * lattice.stride[kSlow] + mid * lattice.stride[kMid];
          for (int fast = 0; fast < lattice.rows[kFast]; ++fast) {
            const float* gradient = sum.gradients[indices[fast * lattice.stride[kFast]]];
            const V fast_offset = offset_from(kFast, fast);
            // The same operations in the same order as in a tile.
            V t = hn::Sub(mid_rest, hn::Mul(fast_offset, fast_offset));
            t = hn::Max(hn::Sub(t, slow_square), zero);
            V l = kDim == 4 ? hn::Mul(hn::Set(d, gradient[kOuter]), outer_offset) : zero;
            if constexpr (kDim >= 3) l = hn::MulAdd(hn::Set(d, gradient[kMid]), mid_offset, l);
            l = hn::MulAdd(hn::Set(d, gradient[kFast]), fast_offset, l);
            if constexpr (kDim >= 2) l = hn::Add(l, hn::Mul(hn::Set(d, gradient[kSlow]), slow_offset));
            if constexpr (kOutput == GradientOutput::value) {
              add_value(t, l, root, value);
            } else {
              V along_gradient;
              V along_offset;
              add_value(t, l, root, value, along_gradient, along_offset);
              const auto add = [&](GradientRole role, V offset) HWY_ATTR {
                along[role] = hn::MulAdd(along_gradient, hn::Set(d, gradient[role]), along[role]);
                along[role] = hn::MulAdd(along_offset, offset, along[role]);
              };
              if constexpr (kDim == 4) add(kOuter, outer_offset);
              if constexpr (kDim >= 2) add(kSlow, slow_offset);
              if constexpr (kDim >= 3) add(kMid, mid_offset);
              add(kFast, fast_offset);
            }
          }
        }
      }
    }
    hn::Store(value, d, results.value + lane);
    if constexpr (kOutput == GradientOutput::value_and_derivative) {
      for (int role = 0; role < kGradientRoles; ++role)
        hn::Store(along[role], d, results.derivative[role] + lane);
    }
  }
}

template <int kDim>
HWY_INLINE void sum_batch(const GradientSum& sum, const GradientTile& tile, GradientOutput output,
                          GradientTileResults& results) {
  if (output == GradientOutput::value) {
    sum_tile<kDim, GradientOutput::value>(sum, tile, results);
  } else {
    sum_tile<kDim, GradientOutput::value_and_derivative>(sum, tile, results);
  }
}

template <int kDim>
HWY_INLINE void sum_batch(const GradientSum& sum, const GradientCluster& cluster, GradientOutput output,
                          GradientClusterResults& results) {
  if (output == GradientOutput::value) {
    sum_cluster<kDim, GradientOutput::value>(sum, cluster, results);
  } else {
    sum_cluster<kDim, GradientOutput::value_and_derivative>(sum, cluster, results);
  }
}

template <typename Batch, typename Results>
void sum_any(const GradientSum& sum, const Batch& batch, GradientOutput output, Results& results) {
  switch (sum.dimensions) {
    case 1:
      return sum_batch<1>(sum, batch, output, results);
    case 2:
      return sum_batch<2>(sum, batch, output, results);
    case 3:
      return sum_batch<3>(sum, batch, output, results);
    default:
      return sum_batch<4>(sum, batch, output, results);
  }
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
