// Sums of waves in a layer around a surface, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/point/point_cluster.h"

#if defined(SOLIDNOISE_LAYER_WAVE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_LAYER_WAVE_SUM_INL
#undef SOLIDNOISE_LAYER_WAVE_SUM_INL
#else
#define SOLIDNOISE_LAYER_WAVE_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace layer_wave_sum {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, PointCluster::kSamples>;
using V = hn::Vec<Tag>;

HWY_INLINE V Dot(const V* a, const V* b) {
  return hn::MulAdd(a[2], b[2], hn::MulAdd(a[1], b[1], hn::Mul(a[0], b[0])));
}

// The polynomial in Chebyshev polynomials of 2 v, by Clenshaw's recurrence.
HWY_INLINE V Polynomial(const LayerWaveKernel& kernel, V v) {
  const Tag d;
  const V four_v = hn::Mul(hn::Set(d, 4.0f), v);
  V next = hn::Zero(d);
  V after = hn::Zero(d);
  for (std::size_t k = kernel.envelope.size() - 1; k >= 1; --k) {
    const V current = hn::MulAdd(four_v, next, hn::Sub(hn::Set(d, kernel.envelope[k]), after));
    after = next;
    next = current;
  }
  return hn::MulAdd(hn::Add(v, v), next, hn::Sub(hn::Set(d, kernel.envelope[0]), after));
}

}  // namespace layer_wave_sum

inline void SumLayerWaves(const LayerWaveKernel& kernel, const PointCluster& cluster,
                          const PointImpulses& impulses, float* values) {
  using namespace layer_wave_sum;
  const Tag d;
  const V one = hn::Set(d, 1.0f);
  const V half = hn::Set(d, 0.5f);
  for (int lane = 0; lane < cluster.count; lane += static_cast<int>(hn::Lanes(d))) {
    V at[3], normal[3], along[3], across[3];
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = hn::Load(d, cluster.coordinate[axis] + lane);
      normal[axis] = hn::Load(d, cluster.normal[axis] + lane);
      along[axis] = hn::Load(d, cluster.tangent[axis] + lane);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int b = (axis + 1) % 3;
      const int c = (axis + 2) % 3;
      across[axis] = hn::NegMulAdd(normal[c], along[b], hn::Mul(normal[b], along[c]));
    }
    const V shrink = hn::Load(d, cluster.inverse_square_radius + lane);
    const V flatten = hn::Load(d, cluster.inverse_square_height + lane);
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i < impulses.size(); ++i) {
      V offset[3];
      for (int axis = 0; axis < 3; ++axis) {
        offset[axis] = hn::Sub(at[axis], hn::Set(d, impulses.position(axis)[i]));
      }
      const V height = Dot(offset, normal);
      const V x = Dot(offset, along);
      const V y = Dot(offset, across);
      const V square = hn::MulAdd(x, x, hn::Mul(y, y));
      const V t = hn::Max(hn::NegMulAdd(square, shrink, one), hn::Zero(d));
      const V inside = hn::Max(hn::NegMulAdd(hn::Mul(height, height), flatten, one), hn::Zero(d));
      const V window = hn::Mul(hn::Mul(t, t), hn::Mul(inside, inside));
      const V turns = hn::MulAdd(x, hn::Set(d, impulses.attribute(PointImpulses::kWaveX)[i]),
                                 hn::Mul(y, hn::Set(d, impulses.attribute(PointImpulses::kWaveY)[i])));
      V cosine, sine;
      CosineSine(d, turns, cosine, sine);
      const V weight = hn::Set(d, impulses.attribute(PointImpulses::kWaveWeight)[i]);
      const V envelope = hn::Mul(Polynomial(kernel, hn::Sub(t, half)), hn::Mul(weight, window));
      sum = hn::MulAdd(envelope, cosine, sum);
    }
    hn::Store(sum, d, values + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_LAYER_WAVE_SUM_INL
