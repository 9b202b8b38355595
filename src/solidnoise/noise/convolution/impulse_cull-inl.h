// Culling of impulses, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <algorithm>
#include <bit>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/impulse_sums.h"

#if defined(SOLIDNOISE_IMPULSE_CULL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_IMPULSE_CULL_INL
#undef SOLIDNOISE_IMPULSE_CULL_INL
#else
#define SOLIDNOISE_IMPULSE_CULL_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Offset of a position from the nearest point of an interval, in radii of the support; 0 inside.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Excess(D d, V position, float lower, float upper, float scale) {
  const V below = hn::Sub(hn::Set(d, lower), position);
  const V above = hn::Sub(position, hn::Set(d, upper));
  return hn::Mul(hn::Max(hn::Max(below, above), hn::Zero(d)), hn::Set(d, scale));
}

// Whether an offset, given by its per-axis excess (accumulated one axis at a time), is inside the support.
// The small margin keeps what rounding might wrongly drop: an impulse kept in vain adds exactly 0.
constexpr float kSupportWithMargin = 1.0f + 1e-5f;

// Stores the kept lanes side by side; what follows them is overwritten next, or padding. With AVX-512 a
// register is compressed and stored whole, for compressing into memory takes a hundred cycles on some
// processors; elsewhere Highway's tables cost more than moving lane by lane.
template <class D, class M, class V = hn::Vec<D>>
HWY_INLINE void StoreKept(D d, V values, M keep, hn::TFromD<D>* to) {
#if HWY_TARGET <= HWY_AVX3
  hn::StoreU(hn::Compress(values, keep), d, to);
#else
  alignas(64) hn::TFromD<D> lanes[hn::MaxLanes(d)];
  hn::Store(values, d, lanes);
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, keep, bytes);
  for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1) *to++ = lanes[std::countr_zero(bits)];
#endif
}

// Appends the impulses of a source that reach the box. A source has their number, position(d, role, i), and
// what else it asks of those that it keeps.
template <class Source>
HWY_INLINE void Cull(const Source& source, const CullBox& box, ImpulseList& list) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const bool ball = box.support == CullBox::Support::ball;
  const int first = role_of_axis(box.dimensions, 0);  // the roles of a noise follow each other
  const int end = first + box.dimensions;
  list.reserve(list.size() + source.size());
  std::size_t kept = list.size();
  for (std::size_t i = 0; i < source.size(); i += hn::Lanes(d)) {
    V distance = hn::Zero(d);
    for (int role = first; role < end; ++role) {
      const V excess =
          Excess(d, source.position(d, role, i), box.lower[role], box.upper[role], box.scale[role]);
      distance = ball ? hn::MulAdd(excess, excess, distance) : hn::Max(distance, excess);
    }
    auto keep = hn::And(hn::Lt(distance, hn::Set(d, kSupportWithMargin)),
                        hn::FirstN(d, std::min(hn::Lanes(d), source.size() - i)));
    keep = source.narrow(d, keep, i);
    for (int role = first; role < end; ++role) {
      StoreKept(d, source.position(d, role, i), keep, list.position(role) + kept);
    }
    for (int channel = 0; channel < box.attributes; ++channel) {
      StoreKept(d, hn::LoadU(d, source.attribute(channel) + i), keep, list.attribute(channel) + kept);
    }
    kept += hn::CountTrue(d, keep);
  }
  list.set_size(kept);
}

// Of a block of impulses.
struct RunSource {
  std::size_t size() const { return run.count; }
  const float* attribute(int channel) const { return run.attribute[static_cast<std::size_t>(channel)]; }
  template <class D>
  HWY_INLINE hn::Vec<D> position(D d, int role, std::size_t i) const {
    const hn::RebindToSigned<D> di;
    const auto quanta = hn::Sub(hn::LoadU(di, run.position[role] + i), hn::Set(di, run.anchor[role]));
    return hn::Mul(hn::ConvertTo(d, quanta), hn::Set(d, 1.0f / (1 << CellAxis::kFractionBits)));
  }
  template <class D, class M>
  HWY_INLINE M narrow(D, M keep, std::size_t) const {
    return keep;
  }

  const ImpulseRun& run;
};

// Of another list, all that reaches the box.
struct ListSource {
  std::size_t size() const { return list.size(); }
  const float* attribute(int channel) const { return list.attribute(channel); }
  template <class D>
  HWY_INLINE hn::Vec<D> position(D d, int role, std::size_t i) const {
    return hn::LoadU(d, list.position(role) + i);
  }
  template <class D, class M>
  HWY_INLINE M narrow(D, M keep, std::size_t) const {
    return keep;
  }

  const ImpulseList& list;
};

// What of it also counts at a point.
struct PointSource : ListSource {
  template <class D, class M>
  HWY_INLINE M narrow(D d, M keep, std::size_t i) const {
    auto along = hn::Mul(position(d, kX, i), hn::Set(d, cull.normal[0]));
    along = hn::MulAdd(position(d, kY, i), hn::Set(d, cull.normal[1]), along);
    along = hn::MulAdd(position(d, kZ, i), hn::Set(d, cull.normal[2]), along);
    const auto turn = hn::LoadU(d, attribute(PointCull::kTurn) + i);
    keep =
        hn::And(keep, hn::And(hn::Ge(along, hn::Set(d, cull.below)), hn::Le(along, hn::Set(d, cull.above))));
    return hn::And(
        keep, hn::And(hn::Ge(turn, hn::Set(d, cull.least_turn)), hn::Le(turn, hn::Set(d, cull.most_turn))));
  }

  const PointCull& cull;
};

inline void CullRun(const ImpulseRun& run, const CullBox& box, ImpulseList& list) {
  Cull(RunSource{run}, box, list);
}

inline void CullList(const ImpulseList& impulses, const PointCull& cull, ImpulseList& list) {
  Cull(PointSource{{impulses}, cull}, cull, list);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_IMPULSE_CULL_INL
