// Distances to the nearest impulses, for one instruction set. Included once per target; see nearest_simd.cpp.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <hwy/highway.h>

#include "solidnoise/noise/cellular/nearest.h"
#include "solidnoise/noise/convolution/impulse_cull-inl.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"

#if defined(SOLIDNOISE_NEAREST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_NEAREST_INL
#undef SOLIDNOISE_NEAREST_INL
#else
#define SOLIDNOISE_NEAREST_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Lanes are samples.
template <Derivatives kDerivatives>
class NearestTerms {
 public:
  static constexpr std::size_t kAtOnce = 1;

  HWY_INLINE NearestTerms(const NearestDistance& nearest, const SampleCluster& cluster,
                          const ImpulseList& list, int lane)
      : nearest_(nearest), list_(list) {
    const PointTag d;
    for (int role = 0; role < kRoles; ++role) {
      at_[role] = hn::Load(d, cluster.coordinate[role] + lane);
      scale_[role] = hn::Set(d, nearest.scale[static_cast<std::size_t>(role)]);
      to_first_[role] = hn::Zero(d);
      to_second_[role] = hn::Zero(d);
    }
  }

  HWY_INLINE void add(std::size_t i) {
    const PointTag d;
    V offset[kRoles];
    for (int role = 0; role < kRoles; ++role) {
      offset[role] = hn::Mul(hn::Sub(at_[role], hn::Set(d, list_.position(role)[i])), scale_[role]);
    }
    const V square = Dot<kRoles>(offset, offset);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const auto is_first = hn::Lt(square, first_);
      const auto is_second = hn::Lt(square, second_);
      for (int role = 0; role < kRoles; ++role) {
        to_second_[role] = hn::IfThenElse(is_second, offset[role], to_second_[role]);
        to_second_[role] = hn::IfThenElse(is_first, to_first_[role], to_second_[role]);
        to_first_[role] = hn::IfThenElse(is_first, offset[role], to_first_[role]);
      }
    }
    second_ = hn::Min(second_, hn::Max(first_, square));
    first_ = hn::Min(first_, square);
  }

  HWY_INLINE void store(int lane, ClusterSums& distances) const {
    const PointTag d;
    const V first = hn::Sqrt(first_);
    const V second = hn::Sqrt(second_);
    const V feature = nearest_.border ? hn::Sub(second, first) : first;
    hn::Store(hn::Add(feature, hn::Set(d, nearest_.lift)), d, distances.value + lane);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const V least = hn::Set(d, 1e-9f);  // the gradient at a point itself is 0
      const V by_first = hn::Div(hn::Set(d, 1.0f), hn::Max(first, least));
      const V by_second = hn::Div(hn::Set(d, 1.0f), hn::Max(second, least));
      for (int role = 0; role < kRoles; ++role) {
        const V slope = hn::Mul(to_first_[role], by_first);
        const V of_second = hn::Mul(to_second_[role], by_second);
        hn::Store(nearest_.border ? hn::Sub(of_second, slope) : slope, d, distances.gradient[role] + lane);
      }
    }
  }

 private:
  using V = PointVector;

  const NearestDistance& nearest_;
  const ImpulseList& list_;
  V at_[kRoles];
  V scale_[kRoles];
  V first_ = hn::Set(PointTag(), 1.0f);  // squares
  V second_ = hn::Set(PointTag(), 1.0f);
  V to_first_[kRoles];
  V to_second_[kRoles];
};

// The second smallest squared distance, in radii, of impulses from the middle of a box; 1 at most.
inline float SecondSquare(const NearestDistance& nearest, const ImpulseList& list, const CullBox& box) {
  const PointTag d;
  using V = PointVector;
  const V one = hn::Set(d, 1.0f);
  V first = one;
  V second = one;
  for (std::size_t i = 0; i < list.size(); i += hn::Lanes(d)) {
    V square = hn::Zero(d);
    for (int role = 0; role < kRoles; ++role) {
      const auto r = static_cast<std::size_t>(role);
      const V middle = hn::Set(d, 0.5f * (box.lower[r] + box.upper[r]));
      const V position = hn::LoadU(d, list.position(role) + i);
      const V offset = hn::Mul(hn::Sub(position, middle), hn::Set(d, nearest.scale[r]));
      square = hn::MulAdd(offset, offset, square);
    }
    square = hn::IfThenElse(hn::FirstN(d, list.size() - i), square, one);
    second = hn::Min(second, hn::Max(first, square));
    first = hn::Min(first, square);
  }
  alignas(64) float lanes[2][SampleCluster::kSamples];
  hn::Store(first, d, lanes[0]);
  hn::Store(second, d, lanes[1]);
  float least[2] = {1.0f, 1.0f};
  for (const auto& row : lanes) {
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      least[1] = std::min(least[1], std::max(least[0], row[lane]));
      least[0] = std::min(least[0], row[lane]);
    }
  }
  return least[1];
}

// Appends the impulses that may be among the two nearest of a sample in the box: no sample's second is
// farther than that of the middle of the box and the way there.
inline void CullToNearest(const NearestDistance& nearest, const ImpulseList& list, CullBox box,
                          ImpulseList& kept) {
  float square = 0.0f;
  for (std::size_t role = 0; role < kRoles; ++role) {
    const float half = 0.5f * (box.upper[role] - box.lower[role]) * nearest.scale[role];
    square += half * half;
  }
  const float most = std::sqrt(SecondSquare(nearest, list, box)) + std::sqrt(square);
  for (std::size_t role = 0; role < kRoles; ++role) box.scale[role] = nearest.scale[role] / most;
  Cull(ListSource{list}, box, kept);
}

template <Derivatives kDerivatives>
HWY_INLINE void NearestInBrick(const NearestDistance& nearest, const ImpulseList& list,
                               const SampleBrick& brick, BrickSums& distances) {
  // Two lines of eight samples at once.
  constexpr int kSide = SampleBrick::kSide;
  constexpr int kLines = SampleCluster::kSamples / kSide;
  SampleCluster lines;
  ClusterSums of_lines;
  lines.count = SampleCluster::kSamples;
  std::fill_n(lines.coordinate[kT], lines.count, brick.time);
  for (int line = 0; line < kLines; ++line) {
    std::copy_n(brick.coordinate[kZ], kSide, lines.coordinate[kZ] + line * kSide);
  }
  for (int x = 0; x < brick.count[kX]; ++x) {
    std::fill_n(lines.coordinate[kX], lines.count, brick.coordinate[kX][x]);
    for (int y = 0; y < brick.count[kY]; y += kLines) {
      for (int line = 0; line < kLines; ++line) {
        std::fill_n(lines.coordinate[kY] + line * kSide, kSide, brick.coordinate[kY][y + line]);
      }
      SumTerms<NearestTerms<kDerivatives>>(nearest, lines, list, of_lines);
      const int first = (x * kSide + y) * kSide;
      std::copy_n(of_lines.value, lines.count, distances.value + first);
      if constexpr (kDerivatives == Derivatives::none) continue;
      for (int role = 0; role < kRoles; ++role) {
        std::copy_n(of_lines.gradient[role], lines.count, distances.gradient[role] + first);
      }
    }
  }
}

inline void FindNearest(const NearestDistance& nearest, const ImpulseList& list, const SampleBrick& brick,
                        Derivatives derivatives, BrickSums& distances) {
  CullBox box{.dimensions = nearest.dimensions};
  for (std::size_t role = 0; role < kT; ++role) {
    box.lower[role] = brick.coordinate[role][0];
    box.upper[role] = brick.coordinate[role][brick.count[role] - 1];
  }
  box.lower[kT] = box.upper[kT] = brick.time;
  ImpulseList kept(nearest.dimensions);
  CullToNearest(nearest, list, box, kept);
  if (derivatives == Derivatives::none) {
    NearestInBrick<Derivatives::none>(nearest, kept, brick, distances);
  } else {
    NearestInBrick<Derivatives::gradient>(nearest, kept, brick, distances);
  }
}

inline void FindNearestScattered(const NearestDistance& nearest, const ImpulseList& list,
                                 const SampleCluster& cluster, Derivatives derivatives,
                                 ClusterSums& distances) {
  CullBox box{.dimensions = nearest.dimensions};
  for (std::size_t role = 0; role < kRoles; ++role) {
    const auto [lower, upper] =
        std::minmax_element(cluster.coordinate[role], cluster.coordinate[role] + cluster.count);
    box.lower[role] = *lower;
    box.upper[role] = *upper;
  }
  ImpulseList kept(nearest.dimensions);
  CullToNearest(nearest, list, box, kept);
  if (derivatives == Derivatives::none) {
    SumTerms<NearestTerms<Derivatives::none>>(nearest, cluster, kept, distances);
  } else {
    SumTerms<NearestTerms<Derivatives::gradient>>(nearest, cluster, kept, distances);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_NEAREST_INL
