// Sums of oriented kernels, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
//
// An oriented kernel is the real part of a product of one complex factor per axis: envelope times wave. On a
// lattice each factor is a small table per impulse, and a sample costs two multiply-adds an impulse.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <numbers>
#include <type_traits>
#include <vector>

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
template <Derivatives kDerivatives, class D, class Kernel, class V = hn::Vec<D>>
HWY_INLINE AxisFactor<V> FactorAlongAxis(D d, const Kernel& envelope, V offset, V wave, V phase,
                                         float scale) {
  const V half = hn::Set(d, 0.5f);
  const V scaled = hn::Mul(offset, hn::Set(d, scale));
  const V v = hn::Max(hn::NegMulAdd(scaled, scaled, half), hn::Set(d, -0.5f));
  const V t = hn::Add(v, half);
  const V t2 = hn::Mul(t, t);
  const V shape = envelope.value(d, v);
  const V amplitude = hn::Mul(t2, shape);
  V cosine, sine;
  CosineSine(d, hn::MulAdd(offset, wave, phase), cosine, sine);

  AxisFactor<V> factor{{hn::Mul(amplitude, cosine), hn::Mul(amplitude, sine)}, {hn::Zero(d), hn::Zero(d)}};
  if constexpr (kDerivatives == Derivatives::gradient) {
    // d amplitude / d scaled = -2 scaled (2 t P + t^2 P'); d wave / d scaled = i 2 pi wave / scale.
    const V slope = envelope.derivative(d, v);
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
  FactorTables(std::size_t impulses, Derivatives derivatives)
      : memory(std::make_unique_for_overwrite<FactorTable[]>(
            impulses * (derivatives == Derivatives::gradient ? 3 + kRoles : 3))) {
    for (int role = 0; role < 3; ++role)
      axis[role] = memory.get() + static_cast<std::size_t>(role) * impulses;
    for (int role = 0; role < kRoles; ++role) {
      derivative[role] = memory.get() + static_cast<std::size_t>(3 + role) * impulses;
    }
  }

  std::unique_ptr<FactorTable[]> memory;
  FactorTable* axis[3];
  FactorTable*
      derivative[kRoles];  // that of time is time's derivative times the x factors; only for gradients
};

template <Derivatives kDerivatives, class Polynomial>
void MakeTables(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                FactorTables& tables) {
  const hn::CappedTag<float, SampleBrick::kSide> d;
  using V = hn::Vec<decltype(d)>;
  const BoundKernel<decltype(d), Polynomial> envelope(d, sum.envelope);
  const V zero = hn::Zero(d);
  const auto store = [&](const Complex<V>& value, FactorTable& table, int piece) HWY_ATTR {
    hn::StoreU(value.re, d, table.re + piece);
    hn::StoreU(value.im, d, table.im + piece);
  };

  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto factor = [&](Role role, V sample) HWY_ATTR {
      const V offset = hn::Sub(sample, hn::Set(d, list.position(role)[i]));
      const V phase = role == kZ ? hn::Set(d, list.attribute(kRoles)[i]) : zero;  // every noise has a z
      return FactorAlongAxis<kDerivatives>(d, envelope, offset, hn::Set(d, list.attribute(role)[i]), phase,
                                           sum.scale[role]);
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

// A brick is summed in tiles, a product of matrices each: two vectors of (x, y) samples, all y of a few x, by
// four z. Where two vectors are less than all y of one x, a tile is several times two vectors.
struct ProductTile {
  static constexpr int kZ = 4;
  static constexpr int kMaxLanes = 16;
  static constexpr int kMaxPlanes = 2 * kMaxLanes / SampleBrick::kSide;
};

// Which impulses reach the `side` samples of an axis from `start` on: bit k of word w is impulse 64 w + k.
inline std::vector<std::uint64_t> ReachingTile(const OrientedSum& sum, const ImpulseList& list,
                                               const SampleBrick& brick, Role role, int start, int side) {
  const float lower = brick.coordinate[role][start];
  const float upper = brick.coordinate[role][std::min(start + side, brick.count[role]) - 1];
  std::vector<std::uint64_t> words;
  for (std::size_t from = 0; from < list.size(); from += 64) {
    words.push_back(SupportBits(from, list.size(), [&](auto d, std::size_t i) HWY_ATTR {
      return SquaredExcess(d, list.position(role) + i, lower, upper, sum.scale[role]);
    }));
  }
  return words;
}

// Which impulses reach which tiles of a brick.
struct ReachingTiles {
  ReachingTiles(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick) {
    const hn::CappedTag<float, ProductTile::kMaxLanes> d;
    planes = std::max(1, 2 * static_cast<int>(hn::Lanes(d)) / SampleBrick::kSide);
    for (int start = 0; start < brick.count[kX]; start += planes) {
      x.push_back(ReachingTile(sum, list, brick, kX, start, planes));
    }
    for (int start = 0; start < brick.count[kZ]; start += ProductTile::kZ) {
      z.push_back(ReachingTile(sum, list, brick, kZ, start, ProductTile::kZ));
    }
  }

  int planes;  // of constant x in a tile
  std::vector<std::vector<std::uint64_t>> x;
  std::vector<std::vector<std::uint64_t>> z;
};

// Calls visit(k) for each set bit k, in order.
template <class Visit>
HWY_INLINE void ForEachBit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

// The products of the x and y factors of 64 impulses, at the (x, y) samples of one tile.
struct PlaneProducts {
  static constexpr int kSamples = 2 * ProductTile::kMaxLanes;

  alignas(64) float re[64][kSamples];
  alignas(64) float im[64][kSamples];
};

// The three axes' factors of impulses.
struct Factors {
  const FactorTable* x;
  const FactorTable* y;
  const FactorTable* z;
};

HWY_INLINE void MultiplyPlanes(const Factors& factors, std::uint64_t impulses, int first_plane, int planes,
                               PlaneProducts& products) {
  constexpr int kSide = SampleBrick::kSide;
  const hn::CappedTag<float, kSide> d;
  using V = hn::Vec<decltype(d)>;
  ForEachBit(impulses, [&](std::size_t i) HWY_ATTR {
    for (int piece = 0; piece < kSide; piece += static_cast<int>(hn::Lanes(d))) {
      const Complex<V> y{hn::LoadU(d, factors.y[i].re + piece), hn::LoadU(d, factors.y[i].im + piece)};
      for (int plane = 0; plane < planes; ++plane) {
        const int x = first_plane + plane;
        const Complex<V> xy =
            Multiply(Complex<V>{hn::Set(d, factors.x[i].re[x]), hn::Set(d, factors.x[i].im[x])}, y);
        hn::StoreU(xy.re, d, products.re[i] + plane * kSide + piece);
        hn::StoreU(xy.im, d, products.im[i] + plane * kSide + piece);
      }
    }
  });
}

// Sums of a tile, z by z.
struct TileSums {
  alignas(64) float of_z[ProductTile::kZ][PlaneProducts::kSamples] = {};
};

// Adds to two vectors of a tile's samples, from `first` on.
HWY_INLINE void AddVectors(const PlaneProducts& products, std::size_t first, const FactorTable* z_factors,
                           std::uint64_t impulses, int first_z, TileSums& sums) {
  const hn::CappedTag<float, ProductTile::kMaxLanes> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t second = first + lanes;
  V low0 = hn::Load(d, sums.of_z[0] + first), high0 = hn::Load(d, sums.of_z[0] + second);
  V low1 = hn::Load(d, sums.of_z[1] + first), high1 = hn::Load(d, sums.of_z[1] + second);
  V low2 = hn::Load(d, sums.of_z[2] + first), high2 = hn::Load(d, sums.of_z[2] + second);
  V low3 = hn::Load(d, sums.of_z[3] + first), high3 = hn::Load(d, sums.of_z[3] + second);
  ForEachBit(impulses, [&](std::size_t i) HWY_ATTR {
    const Complex<V> low{hn::Load(d, products.re[i] + first), hn::Load(d, products.im[i] + first)};
    const Complex<V> high{hn::Load(d, products.re[i] + second), hn::Load(d, products.im[i] + second)};
    const float* const re = z_factors[i].re + first_z;
    const float* const im = z_factors[i].im + first_z;
    const auto add = [&](int k, V& low_sum, V& high_sum) HWY_ATTR {
      const Complex<V> z{hn::Set(d, re[k]), hn::Set(d, im[k])};
      low_sum = AddRealProduct(low, z, low_sum);
      high_sum = AddRealProduct(high, z, high_sum);
    };
    add(0, low0, high0);
    add(1, low1, high1);
    add(2, low2, high2);
    add(3, low3, high3);
  });
  const auto store = [&](int k, V low, V high) HWY_ATTR {
    hn::Store(low, d, sums.of_z[k] + first);
    hn::Store(high, d, sums.of_z[k] + second);
  };
  store(0, low0, high0);
  store(1, low1, high1);
  store(2, low2, high2);
  store(3, low3, high3);
}

HWY_INLINE void AddTile(const PlaneProducts& products, const FactorTable* z_factors, std::uint64_t impulses,
                        int first_z, TileSums& sums) {
  const std::size_t two_vectors = 2 * hn::Lanes(hn::CappedTag<float, ProductTile::kMaxLanes>());
  constexpr std::size_t kSide = SampleBrick::kSide;
  for (std::size_t first = 0; first < std::max(two_vectors, kSide); first += two_vectors) {
    AddVectors(products, first, z_factors, impulses, first_z, sums);
  }
}

// values = sum over impulses of Re(x y z) at every sample of the brick; 64 impulses at a time, which fit the
// nearest cache.
inline void SumProducts(const ReachingTiles& reaching, const Factors& factors, float* values) {
  constexpr int kSide = SampleBrick::kSide;
  PlaneProducts products;
  for (std::size_t x_tile = 0; x_tile < reaching.x.size(); ++x_tile) {
    const int first_plane = static_cast<int>(x_tile) * reaching.planes;
    TileSums sums[kSide / ProductTile::kZ];
    for (std::size_t word = 0; word < reaching.x[x_tile].size(); ++word) {
      const Factors some{factors.x + 64 * word, factors.y + 64 * word, factors.z + 64 * word};
      const std::uint64_t impulses = reaching.x[x_tile][word];
      MultiplyPlanes(some, impulses, first_plane, reaching.planes, products);
      for (std::size_t z_tile = 0; z_tile < reaching.z.size(); ++z_tile) {
        AddTile(products, some.z, impulses & reaching.z[z_tile][word],
                static_cast<int>(z_tile) * ProductTile::kZ, sums[z_tile]);
      }
    }
    float* const to = values + first_plane * kSide * kSide;
    for (int sample = 0; sample < reaching.planes * kSide; ++sample) {
      for (int z = 0; z < kSide; ++z) {
        to[sample * kSide + z] = sums[z / ProductTile::kZ].of_z[z % ProductTile::kZ][sample];
      }
    }
  }
}

template <class Polynomial, Derivatives kDerivatives>
void SumOrientedBrick(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      BrickSums& sums) {
  const std::size_t impulses = list.size();
  FactorTables tables(impulses, kDerivatives);
  const ReachingTiles reaching(sum, list, brick);
  MakeTables<kDerivatives, Polynomial>(sum, list, brick, tables);
  const auto& [x, y, z] = tables.axis;
  SumProducts(reaching, {x, y, z}, sums.value);
  if constexpr (kDerivatives == Derivatives::gradient) {
    SumProducts(reaching, {tables.derivative[kX], y, z}, sums.gradient[kX]);
    SumProducts(reaching, {x, tables.derivative[kY], z}, sums.gradient[kY]);
    SumProducts(reaching, {x, y, tables.derivative[kZ]}, sums.gradient[kZ]);
    SumProducts(reaching, {tables.derivative[kT], y, z}, sums.gradient[kT]);
  }
}

// Lanes are the scattered samples. The same operations in the same order as for a brick.
template <class Polynomial, Derivatives kDerivatives>
void SumOrientedCluster(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                        ClusterSums& sums) {
  const hn::CappedTag<float, SampleCluster::kSamples> d;
  using V = hn::Vec<decltype(d)>;
  const BoundKernel<decltype(d), Polynomial> envelope(d, sum.envelope);
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
        return FactorAlongAxis<kDerivatives>(d, envelope, offset, hn::Set(d, list.attribute(role)[i]), phase,
                                             sum.scale[role]);
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
