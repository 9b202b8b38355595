// Sums of isotropic kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <algorithm>

#include <hwy/highway.h>

#include "solidnoise/noise/impulse_cull-inl.h"
#include "solidnoise/noise/impulse_sums.h"
#include "solidnoise/noise/polynomial-inl.h"

#if defined(SOLIDNOISE_RADIAL_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_RADIAL_SUM_INL
#undef SOLIDNOISE_RADIAL_SUM_INL
#else
#define SOLIDNOISE_RADIAL_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// w t^2 P(v) and, where wanted, its derivative by v, of one vector of samples and one impulse.
template <class D, class Polynomial, class V = hn::Vec<D>>
struct RadialTerm {
  HWY_INLINE RadialTerm(D d, const Polynomial& polynomial, const RadialPolynomial& kernel, V v, V weight) {
    const V half = hn::Set(d, 0.5f);
    const V t = hn::Add(v, half);
    weighted_t = hn::MulAdd(v, weight, hn::Mul(weight, half));
    weighted_t2 = hn::Mul(weighted_t, t);
    value = polynomial(d, v, kernel.value.data());
  }

  HWY_INLINE V derivative(D d, const Polynomial& polynomial, const RadialPolynomial& kernel, V v) const {
    const V slope = polynomial(d, v, kernel.derivative.data());
    return hn::MulAdd(weighted_t2, slope, hn::Mul(hn::Add(weighted_t, weighted_t), value));
  }

  V weighted_t;
  V weighted_t2;
  V value;
};

// The impulses near a 4 x 4 x 4 part of a brick, prepared for summation: what depends on x alone, or on no
// sample, is computed here, once per impulse.
struct NearImpulses {
  static constexpr int kSide = 4;

  explicit NearImpulses(std::size_t capacity) { reserve(capacity); }

  void reserve(std::size_t capacity) {
    for (auto* channel : {&y, &z, &time_offset, &rest, &weight})
      channel->resize(capacity + ImpulseList::kPadding);
    for (int i = 0; i < kSide; ++i) {
      x_offset[i].resize(capacity + ImpulseList::kPadding);
      x_squared[i].resize(capacity + ImpulseList::kPadding);
    }
  }

  std::size_t count = 0;
  std::vector<float> y, z;         // positions, cells from the anchor
  std::vector<float> time_offset;  // radii
  std::vector<float> rest;         // 1/2 minus the squared offset in time
  std::vector<float> weight;
  std::vector<float> x_offset[kSide];  // radii, per x of the part
  std::vector<float> x_squared[kSide];
};

// The part of a brick that starts at (x, y, z).
struct BrickPart {
  int x, y, z;
};

HWY_INLINE void GatherNear(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                           const BrickPart& part, Derivatives derivatives, NearImpulses& near) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  constexpr int kLast = NearImpulses::kSide - 1;
  const V half = hn::Set(d, 0.5f);
  const int start[3] = {part.x, part.y, part.z};

  near.count = 0;
  for (std::size_t i = 0; i < list.size(); i += lanes) {
    V distance = hn::Zero(d);
    for (int role = kX; role <= kZ; ++role) {
      const float* coordinate = brick.coordinate[role] + start[role];
      const V excess =
          Excess(d, hn::LoadU(d, list.position(role) + i), coordinate[0], coordinate[kLast], sum.scale[role]);
      distance = hn::MulAdd(excess, excess, distance);
    }
    const V time_offset = hn::Mul(hn::Sub(hn::Set(d, brick.time), hn::LoadU(d, list.position(kT) + i)),
                                  hn::Set(d, sum.scale[kT]));
    const V time_squared = hn::Mul(time_offset, time_offset);
    distance = hn::Add(distance, time_squared);

    const auto valid = hn::FirstN(d, std::min(lanes, list.size() - i));
    const auto keep = hn::And(hn::Lt(distance, hn::Set(d, kSupportWithMargin)), valid);
    const std::size_t at = near.count;
    near.count += hn::CompressStore(hn::LoadU(d, list.position(kY) + i), keep, d, near.y.data() + at);
    hn::CompressStore(hn::LoadU(d, list.position(kZ) + i), keep, d, near.z.data() + at);
    hn::CompressStore(hn::Sub(half, time_squared), keep, d, near.rest.data() + at);
    hn::CompressStore(hn::LoadU(d, list.attribute(0) + i), keep, d, near.weight.data() + at);
    if (derivatives == Derivatives::gradient) {
      hn::CompressStore(time_offset, keep, d, near.time_offset.data() + at);
    }
    for (int k = 0; k < NearImpulses::kSide; ++k) {
      const V offset =
          hn::Mul(hn::Sub(hn::Set(d, brick.coordinate[kX][part.x + k]), hn::LoadU(d, list.position(kX) + i)),
                  hn::Set(d, sum.scale[kX]));
      hn::CompressStore(hn::Mul(offset, offset), keep, d, near.x_squared[k].data() + at);
      if (derivatives == Derivatives::gradient) {
        hn::CompressStore(offset, keep, d, near.x_offset[k].data() + at);
      }
    }
  }
}

// Sums one part of a brick: lanes are samples of a (y, z) plane, four planes at once, impulses are the loop.
template <class Polynomial, Derivatives kDerivatives>
HWY_INLINE void SumPart(const RadialSum& sum, const NearImpulses& near, const SampleBrick& brick,
                        const BrickPart& part, const Polynomial& polynomial, BrickSums& sums) {
  constexpr int kSide = NearImpulses::kSide;
  const hn::CappedTag<float, kSide * kSide> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V lowest = hn::Set(d, -0.5f);
  const V scale_y = hn::Set(d, sum.scale[kY]);
  const V scale_z = hn::Set(d, sum.scale[kZ]);

  alignas(64) float plane_y[kSide * kSide];
  alignas(64) float plane_z[kSide * kSide];
  for (int i = 0; i < kSide * kSide; ++i) {
    plane_y[i] = brick.coordinate[kY][part.y + i / kSide];
    plane_z[i] = brick.coordinate[kZ][part.z + i % kSide];
  }

  alignas(64) float plane[1 + kRoles][kSide][kSide * kSide];
  for (int piece = 0; piece < kSide * kSide; piece += lanes) {
    const V y = hn::Load(d, plane_y + piece);
    const V z = hn::Load(d, plane_z + piece);
    V value0 = hn::Zero(d), value1 = hn::Zero(d), value2 = hn::Zero(d), value3 = hn::Zero(d);
    V x0 = hn::Zero(d), x1 = hn::Zero(d), x2 = hn::Zero(d), x3 = hn::Zero(d);
    V y0 = hn::Zero(d), y1 = hn::Zero(d), y2 = hn::Zero(d), y3 = hn::Zero(d);
    V z0 = hn::Zero(d), z1 = hn::Zero(d), z2 = hn::Zero(d), z3 = hn::Zero(d);
    V t0 = hn::Zero(d), t1 = hn::Zero(d), t2 = hn::Zero(d), t3 = hn::Zero(d);

    for (std::size_t i = 0; i < near.count; ++i) {
      const V offset_y = hn::Mul(hn::Sub(y, hn::Set(d, near.y[i])), scale_y);
      const V offset_z = hn::Mul(hn::Sub(z, hn::Set(d, near.z[i])), scale_z);
      const V plane_squared = hn::MulAdd(offset_z, offset_z, hn::Mul(offset_y, offset_y));
      const V rest = hn::Sub(hn::Set(d, near.rest[i]), plane_squared);
      const V weight = hn::Set(d, near.weight[i]);

      const auto add = [&](int k, V& value, V& gx, V& gy, V& gz, V& gt) HWY_ATTR {
        const V v = hn::Max(hn::Sub(rest, hn::Set(d, near.x_squared[k][i])), lowest);
        const RadialTerm<decltype(d), Polynomial> term(d, polynomial, sum.kernel, v, weight);
        value = hn::MulAdd(term.weighted_t2, term.value, value);
        if constexpr (kDerivatives == Derivatives::gradient) {
          const V slope = term.derivative(d, polynomial, sum.kernel, v);
          gx = hn::MulAdd(slope, hn::Set(d, near.x_offset[k][i]), gx);
          gy = hn::MulAdd(slope, offset_y, gy);
          gz = hn::MulAdd(slope, offset_z, gz);
          gt = hn::MulAdd(slope, hn::Set(d, near.time_offset[i]), gt);
        }
      };
      add(0, value0, x0, y0, z0, t0);
      add(1, value1, x1, y1, z1, t1);
      add(2, value2, x2, y2, z2, t2);
      add(3, value3, x3, y3, z3, t3);
    }

    const auto store = [&](int k, V value, V gx, V gy, V gz, V gt) HWY_ATTR {
      hn::Store(value, d, plane[0][k] + piece);
      if constexpr (kDerivatives == Derivatives::gradient) {
        hn::Store(gx, d, plane[1 + kX][k] + piece);
        hn::Store(gy, d, plane[1 + kY][k] + piece);
        hn::Store(gz, d, plane[1 + kZ][k] + piece);
        hn::Store(gt, d, plane[1 + kT][k] + piece);
      }
    };
    store(0, value0, x0, y0, z0, t0);
    store(1, value1, x1, y1, z1, t1);
    store(2, value2, x2, y2, z2, t2);
    store(3, value3, x3, y3, z3, t3);
  }

  // d v / d offset = -2 offset.
  constexpr float kChain = -2.0f;
  for (int k = 0; k < kSide; ++k) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const int sample =
          ((part.x + k) * SampleBrick::kSide + part.y + i / kSide) * SampleBrick::kSide + part.z + i % kSide;
      sums.value[sample] = plane[0][k][i];
      if constexpr (kDerivatives == Derivatives::gradient) {
        for (int role = 0; role < kRoles; ++role)
          sums.gradient[role][sample] = kChain * plane[1 + role][k][i];
      }
    }
  }
}

template <class Polynomial, Derivatives kDerivatives>
void SumRadialBrick(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                    BrickSums& sums) {
  const Polynomial polynomial(static_cast<int>(sum.kernel.value.size()) - 1);
  NearImpulses near(list.size());
  for (int x = 0; x < brick.count[kX]; x += NearImpulses::kSide) {
    for (int y = 0; y < brick.count[kY]; y += NearImpulses::kSide) {
      for (int z = 0; z < brick.count[kZ]; z += NearImpulses::kSide) {
        const BrickPart part{x, y, z};
        GatherNear(sum, list, brick, part, kDerivatives, near);
        SumPart<Polynomial, kDerivatives>(sum, near, brick, part, polynomial, sums);
      }
    }
  }
}

// Lanes are the scattered samples. The same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
void SumRadialCluster(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                      ClusterSums& sums) {
  const hn::CappedTag<float, SampleCluster::kSamples> d;
  using V = hn::Vec<decltype(d)>;
  const Polynomial polynomial(static_cast<int>(sum.kernel.value.size()) - 1);
  const V half = hn::Set(d, 0.5f);
  const V lowest = hn::Set(d, -0.5f);

  for (int piece = 0; piece < cluster.count; piece += static_cast<int>(hn::Lanes(d))) {
    V value = hn::Zero(d);
    V gx = hn::Zero(d), gy = hn::Zero(d), gz = hn::Zero(d), gt = hn::Zero(d);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto offset = [&](Role role) HWY_ATTR {
        const V sample = hn::Load(d, cluster.coordinate[role] + piece);
        return hn::Mul(hn::Sub(sample, hn::Set(d, list.position(role)[i])), hn::Set(d, sum.scale[role]));
      };
      const V x = offset(kX), y = offset(kY), z = offset(kZ), t = offset(kT);
      const V plane_squared = hn::MulAdd(z, z, hn::Mul(y, y));
      const V rest = hn::Sub(hn::Sub(half, hn::Mul(t, t)), plane_squared);
      const V v = hn::Max(hn::Sub(rest, hn::Mul(x, x)), lowest);
      const V weight = hn::Set(d, list.attribute(0)[i]);
      const RadialTerm<decltype(d), Polynomial> term(d, polynomial, sum.kernel, v, weight);
      value = hn::MulAdd(term.weighted_t2, term.value, value);
      if constexpr (kDerivatives == Derivatives::gradient) {
        const V slope = term.derivative(d, polynomial, sum.kernel, v);
        gx = hn::MulAdd(slope, x, gx);
        gy = hn::MulAdd(slope, y, gy);
        gz = hn::MulAdd(slope, z, gz);
        gt = hn::MulAdd(slope, t, gt);
      }
    }
    hn::Store(value, d, sums.value + piece);
    if constexpr (kDerivatives == Derivatives::gradient) {
      const V chain = hn::Set(d, -2.0f);  // d v / d offset = -2 offset
      hn::Store(hn::Mul(chain, gx), d, sums.gradient[kX] + piece);
      hn::Store(hn::Mul(chain, gy), d, sums.gradient[kY] + piece);
      hn::Store(hn::Mul(chain, gz), d, sums.gradient[kZ] + piece);
      hn::Store(hn::Mul(chain, gt), d, sums.gradient[kT] + piece);
    }
  }
}

// Calls the evaluator compiled for the kernel's polynomial: Horner's rule for the even degrees up to 12
// (coefficient lists are padded to those), Clenshaw's recurrence otherwise.
template <class Call>
HWY_INLINE void WithPolynomial(const RadialPolynomial& kernel, Call&& call) {
  if (kernel.basis == RadialPolynomial::Basis::chebyshev) return call(Clenshaw(0));
  switch (kernel.value.size()) {
    case 5:
      return call(Horner<4>(0));
    case 7:
      return call(Horner<6>(0));
    case 9:
      return call(Horner<8>(0));
    case 11:
      return call(Horner<10>(0));
    default:
      return call(Horner<12>(0));
  }
}

inline void SumRadial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      Derivatives derivatives, BrickSums& sums) {
  WithPolynomial(sum.kernel, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if (derivatives == Derivatives::none) {
      SumRadialBrick<Polynomial, Derivatives::none>(sum, list, brick, sums);
    } else {
      SumRadialBrick<Polynomial, Derivatives::gradient>(sum, list, brick, sums);
    }
  });
}

inline void SumRadialScattered(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                               Derivatives derivatives, ClusterSums& sums) {
  WithPolynomial(sum.kernel, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if (derivatives == Derivatives::none) {
      SumRadialCluster<Polynomial, Derivatives::none>(sum, list, cluster, sums);
    } else {
      SumRadialCluster<Polynomial, Derivatives::gradient>(sum, list, cluster, sums);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_RADIAL_SUM_INL
