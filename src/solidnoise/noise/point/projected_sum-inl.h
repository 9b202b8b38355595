// Sums of projected gradient noise, for one instruction set. Included once per target; see
// point_sums_simd.cpp.
#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/point/point_cluster.h"

#if defined(SOLIDNOISE_PROJECTED_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_PROJECTED_SUM_INL
#undef SOLIDNOISE_PROJECTED_SUM_INL
#else
#define SOLIDNOISE_PROJECTED_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace projected_sum {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, PointCluster::kSamples>;
using V = hn::Vec<Tag>;

HWY_INLINE V Dot(const V* a, const V* b) {
  return hn::MulAdd(a[2], b[2], hn::MulAdd(a[1], b[1], hn::Mul(a[0], b[0])));
}

// 3 x^2 - 2 x^3.
HWY_INLINE V SmoothStep(V x) {
  const Tag d;
  return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(x, hn::Set(d, 2.0f), hn::Set(d, 3.0f)));
}

// Of u >= 0; 0 for u >= 1.
template <ProjectedKernel::Window kWindow>
HWY_INLINE V Window(V u) {
  const Tag d;
  const V one = hn::Set(d, 1.0f);
  const V inside = hn::Max(hn::Sub(one, u), hn::Zero(d));
  if constexpr (kWindow == ProjectedKernel::Window::hermite) return SmoothStep(inside);
  // cos(pi/2 S(u)) = sin(pi/2 S(1 - u)): exactly 0 at the end.
  V cosine, sine;
  CosineSine(d, hn::Mul(SmoothStep(inside), hn::Set(d, 0.25f)), cosine, sine);
  return sine;
}

template <ProjectedKernel::Window kWindow>
void Sum(const ProjectedKernel& kernel, const PointCluster& cluster, const PointImpulses& impulses,
         float* values) {
  const Tag d;
  const V one = hn::Set(d, 1.0f);
  const V root = hn::Set(d, kernel.root);
  for (int lane = 0; lane < cluster.count; lane += static_cast<int>(hn::Lanes(d))) {
    V at[3], normal[3];
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = hn::Load(d, cluster.coordinate[axis] + lane);
      normal[axis] = hn::Load(d, cluster.normal[axis] + lane);
    }
    const V shrink = hn::Load(d, cluster.inverse_square_radius + lane);
    const V flatten = hn::Sqrt(hn::Load(d, cluster.inverse_square_height + lane));
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i < impulses.size(); ++i) {
      V offset[3], gradient[3];
      for (int axis = 0; axis < 3; ++axis) {
        offset[axis] = hn::Sub(at[axis], hn::Set(d, impulses.position(axis)[i]));
        gradient[axis] = hn::Set(d, impulses.attribute(PointImpulses::kGradientX + axis)[i]);
      }
      const V height = Dot(offset, normal);
      const V square = hn::NegMulAdd(height, height, Dot(offset, offset));
      const V slope = hn::NegMulAdd(height, Dot(normal, gradient), Dot(offset, gradient));
      const V t = hn::Max(hn::NegMulAdd(square, shrink, one), hn::Zero(d));
      const V t2 = hn::Mul(t, t);
      const V window = Window<kWindow>(hn::Mul(hn::Abs(height), flatten));
      const V factor = hn::Mul(hn::Mul(hn::Mul(t2, t2), hn::Sub(t, root)), window);
      sum = hn::MulAdd(factor, slope, sum);
    }
    hn::Store(sum, d, values + lane);
  }
}

}  // namespace projected_sum

inline void SumProjected(const ProjectedKernel& kernel, const PointCluster& cluster,
                         const PointImpulses& impulses, float* values) {
  if (kernel.window == ProjectedKernel::Window::hermite) {
    projected_sum::Sum<ProjectedKernel::Window::hermite>(kernel, cluster, impulses, values);
  } else {
    projected_sum::Sum<ProjectedKernel::Window::cosine>(kernel, cluster, impulses, values);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_PROJECTED_SUM_INL
