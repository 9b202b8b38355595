// Sums of gradient noise over scattered samples of one lattice cell, for one instruction set. Included once
// per target; see gradient_noise_simd.cpp.
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/gradient/gradient_term-inl.h"
#include "solidnoise/noise/gradient/gradient_tile.h"

#if defined(SOLIDNOISE_GRADIENT_CLUSTER_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_GRADIENT_CLUSTER_SUM_INL
#undef SOLIDNOISE_GRADIENT_CLUSTER_SUM_INL
#else
#define SOLIDNOISE_GRADIENT_CLUSTER_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace gradient_noise {

// The sums of one vector of samples, by the same operations in the same order as in a tile.
template <int kDim, Derivatives kDerivatives>
class ClusterLane {
 public:
  HWY_INLINE ClusterLane(const GradientSum& sum, const GradientCluster& cluster, int lane)
      : sum_(sum), cluster_(cluster), lane_(lane), value_(hn::Zero(Tag())) {
    for (V& along : along_) along = hn::Zero(Tag());
  }

  HWY_INLINE void add_all_points() {
    const Tag d;
    const GradientRows& lattice = cluster_.lattice;
    for (int outer = 0; outer < lattice.rows[kOuter]; ++outer) {
      const V outer_offset = offset_from(kOuter, outer);
      const V outer_rest = hn::Sub(hn::Set(d, 1.0f), hn::Mul(outer_offset, outer_offset));
      for (int slow = 0; slow < lattice.rows[kSlow]; ++slow) {
        const V slow_offset = offset_from(kSlow, slow);
        for (int mid = 0; mid < lattice.rows[kMid]; ++mid) {
          const V mid_offset = offset_from(kMid, mid);
          const V rest = hn::Sub(outer_rest, hn::Mul(mid_offset, mid_offset));
          const std::uint8_t* indices = lattice.gradient_index + outer * lattice.stride[kOuter] +
                                        slow * lattice.stride[kSlow] + mid * lattice.stride[kMid];
          for (int fast = 0; fast < lattice.rows[kFast]; ++fast) {
            const V offsets[kGradientRoles] = {outer_offset, slow_offset, mid_offset,
                                               offset_from(kFast, fast)};
            add_point(sum_.gradients[indices[fast * lattice.stride[kFast]]], offsets, rest);
          }
        }
      }
    }
  }

  HWY_INLINE void store(ClusterSums& results) const {
    const Tag d;
    hn::Store(value_, d, results.value + lane_);
    if constexpr (kDerivatives == Derivatives::gradient) {
      for (int role = 0; role < kGradientRoles; ++role) {
        hn::Store(along_[role], d, results.gradient[role] + lane_);
      }
    }
  }

 private:
  HWY_INLINE V offset_from(GradientRole role, int row) const {
    const Tag d;
    return hn::Sub(hn::Load(d, cluster_.coordinate[role] + lane_),
                   hn::Set(d, row_coordinate(sum_, cluster_.lattice, role, row)));
  }

  // `rest`: 1 less the squared offsets along the outer and mid roles.
  HWY_INLINE void add_point(const float* gradient, const V (&offsets)[kGradientRoles], V rest) {
    const Tag d;
    const V root = hn::Set(d, sum_.root);
    V t = hn::Sub(rest, hn::Mul(offsets[kFast], offsets[kFast]));
    t = positive_part(hn::Sub(t, hn::Mul(offsets[kSlow], offsets[kSlow])));
    V l = kDim == 4 ? hn::Mul(hn::Set(d, gradient[kOuter]), offsets[kOuter]) : hn::Zero(d);
    if constexpr (kDim >= 3) l = hn::MulAdd(hn::Set(d, gradient[kMid]), offsets[kMid], l);
    l = hn::MulAdd(hn::Set(d, gradient[kFast]), offsets[kFast], l);
    if constexpr (kDim >= 2) l = hn::Add(l, hn::Mul(hn::Set(d, gradient[kSlow]), offsets[kSlow]));
    if constexpr (kDerivatives == Derivatives::none) {
      add_term(t, l, root, value_);
    } else {
      const TermSlope slope = add_term_with_slope(t, l, root, value_);
      for (int role = 0; role < kGradientRoles; ++role) {
        add_derivative(slope, gradient[role], offsets[role], along_[role]);
      }
    }
  }

  const GradientSum& sum_;
  const GradientCluster& cluster_;
  int lane_;
  V value_;
  V along_[kGradientRoles];
};

template <int kDim, Derivatives kDerivatives>
void sum_terms(const GradientSum& sum, const GradientCluster& cluster, ClusterSums& results) {
  for (int lane = 0; lane < cluster.count; lane += lanes()) {
    ClusterLane<kDim, kDerivatives> samples(sum, cluster, lane);
    samples.add_all_points();
    samples.store(results);
  }
}

}  // namespace gradient_noise
}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif
