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

inline void CullImpulses(const ImpulseRun& run, const CullBox& box, ImpulseList& list) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const V quantum = hn::Set(d, 1.0f / static_cast<float>(1 << CellAxis::kFractionBits));
  const bool ball = box.support == CullBox::Support::ball;

  const auto position = [&](int axis, std::size_t i) HWY_ATTR {
    const auto quanta = hn::Sub(hn::LoadU(di, run.position[axis] + i), hn::Set(di, run.anchor[axis]));
    return hn::Mul(hn::ConvertTo(d, quanta), quantum);
  };

  list.reserve(list.size() + run.count);
  std::size_t kept = list.size();
  for (std::size_t i = 0; i < run.count; i += lanes) {
    V distance = hn::Zero(d);
    for (int axis = 0; axis < run.dimensions; ++axis) {
      const int role = run.role[axis];
      const V excess = Excess(d, position(axis, i), box.lower[role], box.upper[role], box.scale[role]);
      distance = ball ? hn::MulAdd(excess, excess, distance) : hn::Max(distance, excess);
    }
    const auto valid = hn::FirstN(d, std::min(lanes, run.count - i));
    const auto keep = hn::And(hn::Lt(distance, hn::Set(d, kSupportWithMargin)), valid);
    for (int axis = 0; axis < run.dimensions; ++axis) {
      StoreKept(d, position(axis, i), keep, list.position(run.role[axis]) + kept);
    }
    for (int channel = 0; channel < run.attributes; ++channel) {
      StoreKept(d, hn::LoadU(d, run.attribute[channel] + i), keep, list.attribute(channel) + kept);
    }
    kept += hn::CountTrue(d, keep);
  }
  list.set_size(kept);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_IMPULSE_CULL_INL
