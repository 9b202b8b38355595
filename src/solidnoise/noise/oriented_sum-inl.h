// Sums of oriented kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
//
// An oriented kernel is the real part of a product of one complex factor per axis: envelope times wave. On a
// lattice each factor is a small table per impulse, and a sample costs two multiply-adds an impulse.
#include <cmath>
#include <numbers>

#include <hwy/highway.h>

#include "solidnoise/noise/cosine-inl.h"
#include "solidnoise/noise/impulse_sums.h"
#include "solidnoise/noise/polynomial-inl.h"
#include "solidnoise/noise/radial_sum-inl.h"

#if defined(SOLIDNOISE_ORIENTED_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_ORIENTED_SUM_INL
#undef SOLIDNOISE_ORIENTED_SUM_INL
#else
#define SOLIDNOISE_ORIENTED_SUM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Complex {
  V re, im;
};

template <class V>
HWY_INLINE Complex<V> Multiply(const Complex<V>& a, const Complex<V>& b) {
  return {hn::NegMulAdd(a.im, b.im, hn::Mul(a.re, b.re)), hn::MulAdd(a.im, b.re, hn::Mul(a.re, b.im))};
}

// sum + Re(a b)
template <class V>
HWY_INLINE V AddRealProduct(const Complex<V>& a, const Complex<V>& b, V sum) {
  return hn::NegMulAdd(a.im, b.im, hn::MulAdd(a.re, b.re, sum));
}

// One axis' factor of a kernel and its derivative by the offset in half-widths.
template <class V>
struct AxisFactor {
  Complex<V> value;
  Complex<V> derivative;
};

// `offset` from the impulse in cells, `wave` in cycles per cell, `phase` in cycles.
template <Derivatives kDerivatives, class D, class Polynomial, class V = hn::Vec<D>>
HWY_INLINE AxisFactor<V> FactorAlongAxis(D d, const Polynomial& polynomial, const RadialPolynomial& envelope,
                                         V offset, V wave, V phase, float scale) {
  const V half = hn::Set(d, 0.5f);
  const V scaled = hn::Mul(offset, hn::Set(d, scale));
  const V v = hn::Max(hn::NegMulAdd(scaled, scaled, half), hn::Set(d, -0.5f));
  const V t = hn::Add(v, half);
  const V t2 = hn::Mul(t, t);
  const V shape = polynomial(d, v, envelope.value.data());
  const V amplitude = hn::Mul(t2, shape);
  V cosine, sine;
  CosineSine(d, hn::MulAdd(offset, wave, phase), cosine, sine);

  AxisFactor<V> factor;
  factor.value = {hn::Mul(amplitude, cosine), hn::Mul(amplitude, sine)};
  if constexpr (kDerivatives == Derivatives::gradient) {
    // d amplitude / d scaled = -2 scaled (2 t P + t^2 P'); d wave / d scaled = i 2 pi wave / scale.
    const V slope = polynomial(d, v, envelope.derivative.data());
    const V by_v = hn::MulAdd(t2, slope, hn::Mul(hn::Add(t, t), shape));
    const V amplitude_slope = hn::Mul(hn::Mul(hn::Set(d, -2.0f), scaled), by_v);
    const V turning = hn::Mul(hn::Mul(amplitude, wave), hn::Set(d, 2.0f * std::numbers::pi_v<float> / scale));
    factor.derivative = {hn::NegMulAdd(turning, sine, hn::Mul(amplitude_slope, cosine)),
                         hn::MulAdd(turning, cosine, hn::Mul(amplitude_slope, sine))};
  }
  return factor;
}

// A factor at the eight coordinates of one axis of a brick.
struct FactorTable {
  float re[SampleBrick::kSide];
  float im[SampleBrick::kSide];
};

// The factors of all impulses near a brick. A gradient replaces one axis' factors by their derivatives.
struct FactorTables {
  std::vector<FactorTable> axis[3];
  std::vector<FactorTable> derivative[kRoles];  // that of time is time's derivative times the x factors
};

template <Derivatives kDerivatives, class Polynomial>
void MakeTables(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                const Polynomial& polynomial, FactorTables& tables) {
  const hn::CappedTag<float, SampleBrick::kSide> d;
  using V = hn::Vec<decltype(d)>;
  const V zero = hn::Zero(d);
  for (auto& table : tables.axis) table.resize(list.size());
  if constexpr (kDerivatives == Derivatives::gradient) {
    for (auto& table : tables.derivative) table.resize(list.size());
  }
  const auto store = [&](const Complex<V>& value, FactorTable& table, int piece) HWY_ATTR {
    hn::StoreU(value.re, d, table.re + piece);
    hn::StoreU(value.im, d, table.im + piece);
  };

  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto factor = [&](Role role, V sample) HWY_ATTR {
      const V offset = hn::Sub(sample, hn::Set(d, list.position(role)[i]));
      const V phase = role == kZ ? hn::Set(d, list.attribute(kRoles)[i]) : zero;  // every noise has a z
      return FactorAlongAxis<kDerivatives>(d, polynomial, sum.envelope, offset,
                                           hn::Set(d, list.attribute(role)[i]), phase, sum.scale[role]);
    };
    AxisFactor<V> time{{hn::Set(d, 1.0f), zero}, {zero, zero}};
    if (sum.scale[kT] != 0.0f) time = factor(kT, hn::Set(d, brick.time));

    for (int piece = 0; piece < SampleBrick::kSide; piece += static_cast<int>(hn::Lanes(d))) {
      for (int role = kX; role <= kZ; ++role) {
        AxisFactor<V> along{{hn::Set(d, 1.0f), zero}, {zero, zero}};
        if (sum.scale[role] != 0.0f) {
          along = factor(static_cast<Role>(role), hn::Load(d, brick.coordinate[role] + piece));
        }
        if (role == kX) {
          if constexpr (kDerivatives == Derivatives::gradient) {
            store(Multiply(along.value, time.derivative), tables.derivative[kT][i], piece);
          }
          if (sum.scale[kT] != 0.0f) {
            along.value = Multiply(along.value, time.value);
            along.derivative = Multiply(along.derivative, time.value);
          }
        }
        store(along.value, tables.axis[role][i], piece);
        if constexpr (kDerivatives == Derivatives::gradient) {
          store(along.derivative, tables.derivative[role][i], piece);
        }
      }
    }
  }
}

// The products of the x and y factors of the impulses that reach one plane of constant x.
struct PlaneProducts {
  std::vector<FactorTable> xy;
  std::vector<const FactorTable*> z;
};

// values = sum over impulses of Re(x y z) at every sample of the brick.
inline void SumProducts(const std::vector<FactorTable>& x_factors, const std::vector<FactorTable>& y_factors,
                        const std::vector<FactorTable>& z_factors, const SampleBrick& brick,
                        PlaneProducts& plane, float* values) {
  constexpr int kSide = SampleBrick::kSide;
  const hn::CappedTag<float, kSide> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  plane.xy.resize(x_factors.size());
  plane.z.resize(x_factors.size());

  for (int x = 0; x < brick.count[kX]; ++x) {
    // An x factor of exactly 0 is outside the support: the impulse adds nothing to this plane.
    std::size_t reaching = 0;
    for (std::size_t i = 0; i < x_factors.size(); ++i) {
      if (x_factors[i].re[x] == 0.0f && x_factors[i].im[x] == 0.0f) continue;
      const Complex<V> factor{hn::Set(d, x_factors[i].re[x]), hn::Set(d, x_factors[i].im[x])};
      for (int piece = 0; piece < kSide; piece += lanes) {
        const Complex<V> xy = Multiply(
            factor, Complex<V>{hn::LoadU(d, y_factors[i].re + piece), hn::LoadU(d, y_factors[i].im + piece)});
        hn::StoreU(xy.re, d, plane.xy[reaching].re + piece);
        hn::StoreU(xy.im, d, plane.xy[reaching].im + piece);
      }
      plane.z[reaching++] = &z_factors[i];
    }

    float* const rows = values + x * kSide * kSide;
    for (int piece = 0; piece < kSide; piece += lanes) {
      V row0 = hn::Zero(d), row1 = hn::Zero(d), row2 = hn::Zero(d), row3 = hn::Zero(d);
      V row4 = hn::Zero(d), row5 = hn::Zero(d), row6 = hn::Zero(d), row7 = hn::Zero(d);
      for (std::size_t i = 0; i < reaching; ++i) {
        const FactorTable& xy = plane.xy[i];
        const Complex<V> z{hn::LoadU(d, plane.z[i]->re + piece), hn::LoadU(d, plane.z[i]->im + piece)};
        const auto add = [&](int y, V& row) HWY_ATTR {
          row = AddRealProduct(Complex<V>{hn::Set(d, xy.re[y]), hn::Set(d, xy.im[y])}, z, row);
        };
        add(0, row0), add(1, row1), add(2, row2), add(3, row3);
        add(4, row4), add(5, row5), add(6, row6), add(7, row7);
      }
      const V* const all[kSide] = {&row0, &row1, &row2, &row3, &row4, &row5, &row6, &row7};
      for (int y = 0; y < kSide; ++y) hn::StoreU(*all[y], d, rows + y * kSide + piece);
    }
  }
}

template <class Polynomial, Derivatives kDerivatives>
void SumOrientedBrick(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      BrickSums& sums) {
  const Polynomial polynomial(static_cast<int>(sum.envelope.value.size()) - 1);
  FactorTables tables;
  PlaneProducts plane;
  MakeTables<kDerivatives>(sum, list, brick, polynomial, tables);
  const auto& [x, y, z] = tables.axis;
  SumProducts(x, y, z, brick, plane, sums.value);
  if constexpr (kDerivatives == Derivatives::gradient) {
    SumProducts(tables.derivative[kX], y, z, brick, plane, sums.gradient[kX]);
    SumProducts(x, tables.derivative[kY], z, brick, plane, sums.gradient[kY]);
    SumProducts(x, y, tables.derivative[kZ], brick, plane, sums.gradient[kZ]);
    SumProducts(tables.derivative[kT], y, z, brick, plane, sums.gradient[kT]);
  }
}

// Lanes are the scattered samples. The same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
void SumOrientedCluster(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                        ClusterSums& sums) {
  const hn::CappedTag<float, SampleCluster::kSamples> d;
  using V = hn::Vec<decltype(d)>;
  const Polynomial polynomial(static_cast<int>(sum.envelope.value.size()) - 1);
  const V zero = hn::Zero(d);

  for (int piece = 0; piece < cluster.count; piece += static_cast<int>(hn::Lanes(d))) {
    V value = zero;
    V gx = zero, gy = zero, gz = zero, gt = zero;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto factor = [&](Role role) HWY_ATTR {
        if (sum.scale[role] == 0.0f) return AxisFactor<V>{{hn::Set(d, 1.0f), zero}, {zero, zero}};
        const V offset =
            hn::Sub(hn::Load(d, cluster.coordinate[role] + piece), hn::Set(d, list.position(role)[i]));
        const V phase = role == kZ ? hn::Set(d, list.attribute(kRoles)[i]) : zero;
        return FactorAlongAxis<kDerivatives>(d, polynomial, sum.envelope, offset,
                                             hn::Set(d, list.attribute(role)[i]), phase, sum.scale[role]);
      };
      AxisFactor<V> x = factor(kX);
      const AxisFactor<V> y = factor(kY), z = factor(kZ), t = factor(kT);
      const Complex<V> x_by_time = Multiply(x.value, t.derivative);
      if (sum.scale[kT] != 0.0f) {
        x.value = Multiply(x.value, t.value);
        x.derivative = Multiply(x.derivative, t.value);
      }
      value = AddRealProduct(Multiply(x.value, y.value), z.value, value);
      if constexpr (kDerivatives == Derivatives::gradient) {
        gx = AddRealProduct(Multiply(x.derivative, y.value), z.value, gx);
        gy = AddRealProduct(Multiply(x.value, y.derivative), z.value, gy);
        gz = AddRealProduct(Multiply(x.value, y.value), z.derivative, gz);
        gt = AddRealProduct(Multiply(x_by_time, y.value), z.value, gt);
      }
    }
    hn::Store(value, d, sums.value + piece);
    if constexpr (kDerivatives == Derivatives::gradient) {
      hn::Store(gx, d, sums.gradient[kX] + piece);
      hn::Store(gy, d, sums.gradient[kY] + piece);
      hn::Store(gz, d, sums.gradient[kZ] + piece);
      hn::Store(gt, d, sums.gradient[kT] + piece);
    }
  }
}

template <class Samples, class SamplesSums>
HWY_INLINE void SumOriented(const OrientedSum& sum, const ImpulseList& list, const Samples& samples,
                            Derivatives derivatives, SamplesSums& sums) {
  WithPolynomial(sum.envelope, [&](const auto& polynomial) {
    using Polynomial = std::decay_t<decltype(polynomial)>;
    if constexpr (std::is_same_v<Samples, SampleBrick>) {
      derivatives == Derivatives::none
          ? SumOrientedBrick<Polynomial, Derivatives::none>(sum, list, samples, sums)
          : SumOrientedBrick<Polynomial, Derivatives::gradient>(sum, list, samples, sums);
    } else {
      derivatives == Derivatives::none
          ? SumOrientedCluster<Polynomial, Derivatives::none>(sum, list, samples, sums)
          : SumOrientedCluster<Polynomial, Derivatives::gradient>(sum, list, samples, sums);
    }
  });
}

inline void SumOrientedLattice(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                               Derivatives derivatives, BrickSums& sums) {
  SumOriented(sum, list, brick, derivatives, sums);
}

inline void SumOrientedScattered(const OrientedSum& sum, const ImpulseList& list,
                                 const SampleCluster& cluster, Derivatives derivatives, ClusterSums& sums) {
  SumOriented(sum, list, cluster, derivatives, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_ORIENTED_SUM_INL
