// Sums in a layer around a surface, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <numbers>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/convolution/point_terms-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"
#include "solidnoise/noise/point/point_cluster.h"

#if defined(SOLIDNOISE_SURFACE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_SURFACE_SUM_INL
#undef SOLIDNOISE_SURFACE_SUM_INL
#else
#define SOLIDNOISE_SURFACE_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace surface_sum {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = PointTag;
using V = PointVector;

// Where the points are, and how far the kernel reaches along the surface and across it.
struct Frame {
  HWY_INLINE Frame(const PointCluster& cluster, int lane) {
    const Tag d;
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = hn::Load(d, cluster.coordinate[axis] + lane);
      normal[axis] = hn::Load(d, cluster.normal[axis] + lane);
    }
    shrink = hn::Load(d, cluster.inverse_square_radius + lane);
    flatten = hn::Load(d, cluster.inverse_square_height + lane);
  }

  HWY_INLINE void offset_from(const ImpulseList& impulses, std::size_t i, V (&offset)[3]) const {
    for (int axis = 0; axis < 3; ++axis) {
      offset[axis] = hn::Sub(at[axis], hn::Set(Tag(), impulses.position(axis)[i]));
    }
  }

  V at[3], normal[3];
  V shrink, flatten;
};

template <Derivatives kDerivatives>
class LayerWaveTerms {
 public:
  static constexpr std::size_t kAtOnce = 1;

  HWY_INLINE LayerWaveTerms(const LayerWaveKernel& kernel, const PointCluster& cluster,
                            const ImpulseList& impulses, int lane)
      : impulses_(impulses), envelope_(Tag(), kernel.envelope), frame_(cluster, lane) {
    for (int axis = 0; axis < 3; ++axis) along_[axis] = hn::Load(Tag(), cluster.tangent[axis] + lane);
    for (int axis = 0; axis < 3; ++axis) {
      const int b = (axis + 1) % 3;
      const int c = (axis + 2) % 3;
      across_[axis] = hn::NegMulAdd(frame_.normal[c], along_[b], hn::Mul(frame_.normal[b], along_[c]));
    }
  }

  HWY_INLINE void add(std::size_t i) {
    const Tag d;
    const V one = hn::Set(d, 1.0f);
    V offset[3];
    frame_.offset_from(impulses_, i, offset);
    const V height = Dot<3>(offset, frame_.normal);
    const V x = Dot<3>(offset, along_);
    const V y = Dot<3>(offset, across_);
    const V square = hn::MulAdd(x, x, hn::Mul(y, y));
    const V t = hn::Max(hn::NegMulAdd(square, frame_.shrink, one), hn::Zero(d));
    const V inside = hn::Max(hn::NegMulAdd(hn::Mul(height, height), frame_.flatten, one), hn::Zero(d));
    const V layer = hn::Mul(inside, inside);
    const V wave_x = attribute(kWaveX, i);
    const V wave_y = attribute(kWaveY, i);
    const V weight = attribute(kWaveWeight, i);
    V cosine, sine;
    CosineSine(d, hn::MulAdd(x, wave_x, hn::Mul(y, wave_y)), cosine, sine);
    const V weighted = hn::Mul(weight, layer);
    const V envelope = envelope_.value.of(d, t, weighted);
    sum_ = hn::MulAdd(envelope, cosine, sum_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      // d t / d x = -2 x / r^2; the wave turns by 2 pi in a cycle.
      const V by_t = hn::Mul(envelope_.slope.of(d, t, weighted), cosine);
      const V by_square = hn::Mul(by_t, hn::Mul(hn::Set(d, -2.0f), frame_.shrink));
      const V turning = hn::Mul(hn::Mul(envelope, sine), hn::Set(d, 2.0f * std::numbers::pi_v<float>));
      slope_along_ = hn::MulAdd(by_square, x, hn::NegMulAdd(turning, wave_x, slope_along_));
      slope_across_ = hn::MulAdd(by_square, y, hn::NegMulAdd(turning, wave_y, slope_across_));
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    const Tag d;
    hn::Store(sum_, d, sums.value + lane);
    for (int axis = 0; kDerivatives == Derivatives::gradient && axis < 3; ++axis) {
      const V slope = hn::MulAdd(slope_along_, along_[axis], hn::Mul(slope_across_, across_[axis]));
      hn::Store(slope, d, sums.gradient[axis] + lane);
    }
  }

 private:
  HWY_INLINE V attribute(int channel, std::size_t i) const {
    return hn::Set(Tag(), impulses_.attribute(channel)[i]);
  }

  const ImpulseList& impulses_;
  RadialKernel<kRadialTaper, Clenshaw, Tag> envelope_;
  Frame frame_;
  V along_[3];
  V across_[3];
  V sum_ = hn::Zero(Tag());
  V slope_along_ = hn::Zero(Tag());
  V slope_across_ = hn::Zero(Tag());
};

// 3 x^2 - 2 x^3.
HWY_INLINE V SmoothStep(V x) {
  const Tag d;
  return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(x, hn::Set(d, 2.0f), hn::Set(d, 3.0f)));
}

template <Derivatives kDerivatives>
class ProjectedTerms {
 public:
  static constexpr std::size_t kAtOnce = 1;

  HWY_INLINE ProjectedTerms(const ProjectedKernel& kernel, const PointCluster& cluster,
                            const ImpulseList& impulses, int lane)
      : impulses_(impulses), frame_(cluster, lane), root_(hn::Set(Tag(), kernel.root)) {
    frame_.flatten = hn::Sqrt(frame_.flatten);
    for (int axis = 0; axis < 3; ++axis) slope_[axis] = hn::Zero(Tag());
  }

  HWY_INLINE void add(std::size_t i) {
    const Tag d;
    V offset[3], gradient[3];
    frame_.offset_from(impulses_, i, offset);
    for (int axis = 0; axis < 3; ++axis) {
      gradient[axis] = hn::Set(d, impulses_.attribute(kGradientX + axis)[i]);
    }
    const V height = Dot<3>(offset, frame_.normal);
    const V square = hn::NegMulAdd(height, height, Dot<3>(offset, offset));
    const V slope = hn::NegMulAdd(height, Dot<3>(frame_.normal, gradient), Dot<3>(offset, gradient));
    const V t = hn::Max(hn::NegMulAdd(square, frame_.shrink, hn::Set(d, 1.0f)), hn::Zero(d));
    const V t2 = hn::Mul(t, t);
    const V inside = hn::Sub(hn::Set(d, 1.0f), hn::Mul(hn::Abs(height), frame_.flatten));
    const V window = SmoothStep(hn::Max(inside, hn::Zero(d)));
    const V factor = hn::Mul(hn::Mul(hn::Mul(t2, t2), hn::Sub(t, root_)), window);
    sum_ = hn::MulAdd(factor, slope, sum_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      // d (t^4 (t - root)) / d t = t^3 (5 t - 4 root), and d t / d A = -2 A / r^2.
      const V polynomial = hn::NegMulAdd(hn::Set(d, 4.0f), root_, hn::Mul(hn::Set(d, 5.0f), t));
      const V by_t = hn::Mul(hn::Mul(hn::Mul(t2, t), polynomial), hn::Mul(window, slope));
      const V by_square = hn::Mul(by_t, hn::Mul(hn::Set(d, -2.0f), frame_.shrink));
      for (int axis = 0; axis < 3; ++axis) {
        slope_[axis] = hn::MulAdd(by_square, offset[axis], hn::MulAdd(factor, gradient[axis], slope_[axis]));
      }
    }
  }

  HWY_INLINE void store(int lane, ClusterSums& sums) const {
    hn::Store(sum_, Tag(), sums.value + lane);
    for (int axis = 0; kDerivatives == Derivatives::gradient && axis < 3; ++axis) {
      hn::Store(slope_[axis], Tag(), sums.gradient[axis] + lane);
    }
  }

 private:
  const ImpulseList& impulses_;
  Frame frame_;
  V root_;
  V sum_ = hn::Zero(Tag());
  V slope_[3];
};

}  // namespace surface_sum

inline void SumLayerWaves(const LayerWaveKernel& kernel, const PointCluster& cluster,
                          const ImpulseList& impulses, ClusterSums& sums) {
  using surface_sum::LayerWaveTerms;
  if (cluster.derivatives != Derivatives::none) {
    SumTerms<LayerWaveTerms<Derivatives::gradient>>(kernel, cluster, impulses, sums);
  } else {
    SumTerms<LayerWaveTerms<Derivatives::none>>(kernel, cluster, impulses, sums);
  }
}

inline void SumProjected(const ProjectedKernel& kernel, const PointCluster& cluster,
                         const ImpulseList& impulses, ClusterSums& sums) {
  using surface_sum::ProjectedTerms;
  if (cluster.derivatives != Derivatives::none) {
    SumTerms<ProjectedTerms<Derivatives::gradient>>(kernel, cluster, impulses, sums);
  } else {
    SumTerms<ProjectedTerms<Derivatives::none>>(kernel, cluster, impulses, sums);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_SURFACE_SUM_INL
