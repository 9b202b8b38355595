// One lattice point's term of gradient noise, for one instruction set. Included once per target; see
// gradient_noise_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/gradient/gradient_tile.h"

#if defined(SOLIDNOISE_GRADIENT_TERM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_GRADIENT_TERM_INL
#undef SOLIDNOISE_GRADIENT_TERM_INL
#else
#define SOLIDNOISE_GRADIENT_TERM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, GradientTile::kLanes>;
using IndexTag = hn::RebindToSigned<Tag>;
using V = hn::Vec<Tag>;

inline int lanes() {
  return static_cast<int>(hn::Lanes(Tag()));
}

// max(t, 0). Floats are in the order of their bits as integers where one of them is 0 or more, and the
// maximum of integers does not compete with the multiplications for the processor's units.
HWY_INLINE V positive_part(V t) {
  const Tag d;
  const IndexTag di;
  return hn::BitCast(d, hn::Max(hn::BitCast(di, t), hn::Zero(di)));
}

// Adds the term t^4 (t - root) l to the value.
HWY_INLINE void add_term(V t, V l, V root, V& value) {
  const V t2 = hn::Mul(t, t);
  const V t4 = hn::Mul(t2, t2);
  value = hn::MulAdd(hn::Mul(t4, l), hn::Sub(t, root), value);
}

// The factors of the term's derivative, along_gradient * gradient + along_offset * offset.
struct TermSlope {
  V along_gradient;
  V along_offset;
};

// The same to the bit, and the slope: with s = t^4 (t - root) the factors are s and
// -2 l ds/dt = -2 l t^3 (5 t - 4 root).
HWY_INLINE TermSlope add_term_with_slope(V t, V l, V root, V& value) {
  const Tag d;
  const V t2 = hn::Mul(t, t);
  const V t4 = hn::Mul(t2, t2);
  const V factor = hn::Sub(t, root);
  value = hn::MulAdd(hn::Mul(t4, l), factor, value);
  const V slope = hn::MulAdd(hn::Set(d, -10.0f), t, hn::Mul(hn::Set(d, 8.0f), root));
  return {hn::Mul(t4, factor), hn::Mul(hn::Mul(hn::Mul(t2, t), l), slope)};
}

// Adds the term's derivative along one role.
HWY_INLINE void add_derivative(const TermSlope& slope, float gradient, V offset, V& derivative) {
  const Tag d;
  derivative = hn::MulAdd(slope.along_gradient, hn::Set(d, gradient), derivative);
  derivative = hn::MulAdd(slope.along_offset, offset, derivative);
}

HWY_INLINE float row_coordinate(const GradientSum& sum, const GradientRows& lattice, int role, int row) {
  return lattice.first[role] + sum.spacing * static_cast<float>(row);
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
