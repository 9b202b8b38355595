// Sums of oriented kernels on a brick of samples, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
//
// An oriented kernel is the real part of a product of one complex factor per axis: envelope times wave. On a
// lattice each factor is a small table per impulse, and a sample costs two multiply-adds an impulse.
//
// The leaves of a layer have factors in common. Tables of them for a whole block were tried: they are slower
// than making factors anew as soon as they leave the nearest caches, in blocks of 64^3 voxels.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/oriented_factor-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"
#include "solidnoise/noise/convolution/radial_brick-inl.h"

#if defined(SOLIDNOISE_ORIENTED_BRICK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_ORIENTED_BRICK_INL
#undef SOLIDNOISE_ORIENTED_BRICK_INL
#else
#define SOLIDNOISE_ORIENTED_BRICK_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Impulses are taken 64 at a time: their tables fit the nearest cache.
constexpr std::size_t kChunk = 64;

// Factors of a chunk's impulses at the eight coordinates of one axis, coordinate by coordinate.
struct FactorRows {
  alignas(64) float re[SampleBrick::kSide][kChunk];
  alignas(64) float im[SampleBrick::kSide][kChunk];
};

// The same, impulse by impulse.
struct FactorLines {
  alignas(64) float re[kChunk][SampleBrick::kSide];
  alignas(64) float im[kChunk][SampleBrick::kSide];
};

// The factors of a chunk, or their derivatives. The x factors include those of time.
struct ChunkFactors {
  FactorRows x;
  FactorRows y;
  FactorLines z;
};
struct ChunkDerivatives : ChunkFactors {
  FactorRows time;  // derivative by time, times the x factors
};

// A vector of (y, z) samples: of two planes of constant y where vectors have 16 lanes, else of one or a part
// of one. Lines of factors are made likewise, of two impulses or of one.
struct PlaneVector {
  static constexpr int kSide = SampleBrick::kSide;
#if HWY_TARGET <= HWY_AVX3
  using Tag = hn::CappedTag<float, 2 * kSide>;
  using V = hn::Vec<Tag>;

  static constexpr int kPlanes = 2;

  // One value for each plane.
  static HWY_INLINE V spread(const float* first, const float* second) {
    return hn::IfThenElse(hn::FirstN(Tag(), kSide), hn::Set(Tag(), *first), hn::Set(Tag(), *second));
  }

  // A line's values in each plane.
  static HWY_INLINE V repeat(const float* line, int) {
    const auto all = hn::Load(hn::Half<Tag>(), line);
    return hn::Combine(Tag(), all, all);
  }

  static HWY_INLINE void store(V values, float (*lines)[kSide], int) {
    const hn::Half<Tag> half;
    hn::Store(hn::LowerHalf(half, values), half, lines[0]);
    hn::Store(hn::UpperHalf(half, values), half, lines[1]);
  }
#else
  using Tag = hn::CappedTag<float, kSide>;
  using V = hn::Vec<Tag>;

  static constexpr int kPlanes = 1;

  static HWY_INLINE V spread(const float* first, const float*) {
    return hn::Set(Tag(), *first);
  }

  // A line's values from `piece` on.
  static HWY_INLINE V repeat(const float* line, int piece) {
    return hn::Load(Tag(), line + piece);
  }

  static HWY_INLINE void store(V values, float (*lines)[kSide], int piece) {
    hn::Store(values, Tag(), lines[0] + piece);
  }
#endif

  static HWY_INLINE int lanes() {
    return static_cast<int>(hn::Lanes(Tag()));
  }
};

// A brick is summed in tiles: a vector of (y, z) samples, by this many x. The fewer x, the more often the
// products of y and z factors are made, but the fewer samples out of an impulse's reach are summed with those
// within it: as long as the brick is narrow beside the kernel, all are best.
HWY_INLINE int TileSide(const OrientedSum& sum, const SampleBrick& brick) {
  constexpr float kWide = 0.8f;  // half-widths of the support; from equal counts of multiply-adds
  if (brick.count[kX] == 1) return 1;
  const float width = brick.coordinate[kX][brick.count[kX] - 1] - brick.coordinate[kX][0];
  return brick.count[kX] <= 4 || width * sum.scale[kX] > kWide ? 4 : SampleBrick::kSide;
}

// Calls store(value, sample, impulse) for each of the first `samples` coordinates of an axis, lanes being the
// impulses of the chunk from `from` on.
template <Derivatives kDerivatives, class Polynomial, class Store>
HWY_INLINE void ForEachRow(const OrientedSum& sum, const ImpulseList& list, std::size_t from, Role role,
                           const float* coordinates, int samples, const Store& store) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const RadialKernel<kAxisTaper, Polynomial, decltype(d)> envelope(d, sum.envelope);
  const V zero = hn::Zero(d);
  const std::size_t count = std::min(kChunk, list.size() - from);
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const V position = hn::LoadU(d, list.position(role) + from + k);
    const V wave = hn::LoadU(d, list.attribute(OrientedSum::wave(role)) + from + k);
    for (int sample = 0; sample < samples; ++sample) {
      AxisFactor<V> along{{hn::Set(d, 1.0f), zero}, {zero, zero}};
      if (sum.scale[role] != 0.0f) {
        along = FactorAlongAxis<kDerivatives>(d, envelope, hn::Sub(hn::Set(d, coordinates[sample]), position),
                                              wave, zero, hn::Set(d, 1.0f), sum.scale[role]);
      }
      store(along, sample, k);
    }
  }
}

HWY_INLINE void StoreRow(const Complex<hn::Vec<hn::CappedTag<float, 16>>>& value, FactorRows& rows,
                         int sample, std::size_t impulse) {
  const hn::CappedTag<float, 16> d;
  hn::Store(value.re, d, rows.re[sample] + impulse);
  hn::Store(value.im, d, rows.im[sample] + impulse);
}

template <Derivatives kDerivatives, class Polynomial>
HWY_INLINE void MakeLines(const OrientedSum& sum, const ImpulseList& list, std::size_t from,
                          const float* coordinates, ChunkFactors& factors, ChunkDerivatives& derivatives) {
  const PlaneVector::Tag d;
  const RadialKernel<kAxisTaper, Polynomial, PlaneVector::Tag> envelope(d, sum.envelope);
  const std::size_t count = std::min(kChunk, list.size() - from);
  const auto of_impulses = [&](const float* values)
                               HWY_ATTR { return PlaneVector::spread(values, values + 1); };
  for (std::size_t k = 0; k < count; k += PlaneVector::kPlanes) {
    const auto position = of_impulses(list.position(kZ) + from + k);
    const auto wave = of_impulses(list.attribute(OrientedSum::wave(kZ)) + from + k);
    const auto phase = of_impulses(list.attribute(OrientedSum::kPhase) + from + k);
    const auto weight =
        sum.weighted ? of_impulses(list.attribute(OrientedSum::kWeight) + from + k) : hn::Set(d, 1.0f);
    for (int piece = 0; piece < SampleBrick::kSide; piece += PlaneVector::lanes()) {
      const auto offset = hn::Sub(PlaneVector::repeat(coordinates, piece), position);
      const auto along =
          FactorAlongAxis<kDerivatives>(d, envelope, offset, wave, phase, weight, sum.scale[kZ]);
      PlaneVector::store(along.value.re, factors.z.re + k, piece);
      PlaneVector::store(along.value.im, factors.z.im + k, piece);
      if constexpr (kDerivatives == Derivatives::gradient) {
        PlaneVector::store(along.derivative.re, derivatives.z.re + k, piece);
        PlaneVector::store(along.derivative.im, derivatives.z.im + k, piece);
      }
    }
  }
}

// Makes the factors of the impulses from `from` on, and their derivatives if they are wanted.
template <Derivatives kDerivatives, class Polynomial>
HWY_INLINE void MakeFactors(const OrientedSum& sum, const ImpulseList& list, std::size_t from,
                            const SampleBrick& brick, ChunkFactors& factors, ChunkDerivatives& derivatives) {
  constexpr bool kGradient = kDerivatives == Derivatives::gradient;
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  // Whole tiles are summed.
  const auto in_tiles = [](int count, int side) { return (count + side - 1) / side * side; };
  const int x_side = TileSide(sum, brick);

  FactorRows time;
  FactorRows time_derivative;
  if (sum.scale[kT] != 0.0f) {
    ForEachRow<kDerivatives, Polynomial>(sum, list, from, kT, &brick.time, 1,
                                         [&](const AxisFactor<V>& along, int, std::size_t k) HWY_ATTR {
                                           StoreRow(along.value, time, 0, k);
                                           if constexpr (kGradient)
                                             StoreRow(along.derivative, time_derivative, 0, k);
                                         });
  }
  const auto load = [&](const FactorRows& rows, std::size_t k) HWY_ATTR {
    return Complex<V>{hn::Load(d, rows.re[0] + k), hn::Load(d, rows.im[0] + k)};
  };
  ForEachRow<kDerivatives, Polynomial>(
      sum, list, from, kX, brick.coordinate[kX], in_tiles(brick.count[kX], x_side),
      [&](AxisFactor<V> along, int sample, std::size_t k) HWY_ATTR {
        if (sum.scale[kT] != 0.0f) {
          if constexpr (kGradient) {
            StoreRow(Multiply(along.value, load(time_derivative, k)), derivatives.time, sample, k);
          }
          along.value = Multiply(along.value, load(time, k));
          along.derivative = Multiply(along.derivative, load(time, k));
        }
        StoreRow(along.value, factors.x, sample, k);
        if constexpr (kGradient) StoreRow(along.derivative, derivatives.x, sample, k);
      });
  ForEachRow<kDerivatives, Polynomial>(sum, list, from, kY, brick.coordinate[kY],
                                       in_tiles(brick.count[kY], PlaneVector::kPlanes),
                                       [&](const AxisFactor<V>& along, int sample, std::size_t k) HWY_ATTR {
                                         StoreRow(along.value, factors.y, sample, k);
                                         if constexpr (kGradient)
                                           StoreRow(along.derivative, derivatives.y, sample, k);
                                       });
  MakeLines<kDerivatives, Polynomial>(sum, list, from, brick.coordinate[kZ], factors, derivatives);
}

// Bit k: whether impulse from + k reaches the samples from `start` to `start + side - 1` of an axis.
HWY_INLINE std::uint64_t Reaching(const OrientedSum& sum, const ImpulseList& list, std::size_t from,
                                  Role role, const SampleBrick& brick, int start, int side) {
  const float lower = brick.coordinate[role][start];
  const float upper = brick.coordinate[role][std::min(start + side, brick.count[role]) - 1];
  return SupportBits(from, list.size(), [&](auto d, std::size_t i) HWY_ATTR {
    return SquaredExcess(d, list.position(role) + i, lower, upper, sum.scale[role]);
  });
}

// Which impulses of a chunk reach the tiles of a brick, by their first sample along each axis.
struct ReachingTiles {
  ReachingTiles(const OrientedSum& sum, const ImpulseList& list, std::size_t from, const SampleBrick& brick)
      : x_side(TileSide(sum, brick)) {
    for (int start = 0; start < brick.count[kX]; start += x_side) {
      x[start] = Reaching(sum, list, from, kX, brick, start, x_side);
    }
    for (int start = 0; start < brick.count[kY]; start += PlaneVector::kPlanes) {
      y[start] = Reaching(sum, list, from, kY, brick, start, PlaneVector::kPlanes);
    }
  }

  int x_side;
  std::array<std::uint64_t, SampleBrick::kSide> x;
  std::array<std::uint64_t, SampleBrick::kSide> y;
};

// Calls visit(k) for each set bit k, in order.
template <class Visit>
HWY_INLINE void ForEachBit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

// Where a tile starts in its brick.
struct Tile {
  int x, y, z;
};

// Adds to a tile of kSide samples along x, at `sums` and for each following x a plane further, the sum over a
// chunk's impulses of Re(x y z).
template <int kSide>
HWY_INLINE void AddTile(const FactorRows& x, const FactorRows& y, const FactorLines& z,
                        std::uint64_t impulses, const Tile& tile, float* sums) {
  static_assert(kSide == 1 || kSide == 4 || kSide == 8);
  constexpr int kPlane = SampleBrick::kSide * SampleBrick::kSide;
  const PlaneVector::Tag d;
  using V = PlaneVector::V;
  const auto load = [&](int k) HWY_ATTR { return k < kSide ? hn::Load(d, sums + k * kPlane) : hn::Zero(d); };
  V sum0 = load(0), sum1 = load(1), sum2 = load(2), sum3 = load(3);
  V sum4 = load(4), sum5 = load(5), sum6 = load(6), sum7 = load(7);
  const int last = tile.y + PlaneVector::kPlanes - 1;
  ForEachBit(impulses, [&](std::size_t i) HWY_ATTR {
    const Complex<V> row{PlaneVector::spread(y.re[tile.y] + i, y.re[last] + i),
                         PlaneVector::spread(y.im[tile.y] + i, y.im[last] + i)};
    const Complex<V> line{PlaneVector::repeat(z.re[i], tile.z), PlaneVector::repeat(z.im[i], tile.z)};
    const Complex<V> product = Multiply(row, line);
    const auto add = [&](int k, V& sum) HWY_ATTR {
      sum = AddRealProduct(product, {hn::Set(d, x.re[tile.x + k][i]), hn::Set(d, x.im[tile.x + k][i])}, sum);
    };
    add(0, sum0);
    if constexpr (kSide > 1) {
      add(1, sum1);
      add(2, sum2);
      add(3, sum3);
    }
    if constexpr (kSide > 4) {
      add(4, sum4);
      add(5, sum5);
      add(6, sum6);
      add(7, sum7);
    }
  });
  const auto store = [&](int k, V sum) HWY_ATTR {
    if (k < kSide) hn::Store(sum, d, sums + k * kPlane);
  };
  store(0, sum0);
  store(1, sum1);
  store(2, sum2);
  store(3, sum3);
  store(4, sum4);
  store(5, sum5);
  store(6, sum6);
  store(7, sum7);
}

// sums += sum over a chunk's impulses of Re(x y z) at every sample of the brick.
HWY_INLINE void AddProducts(const ReachingTiles& reaching, const SampleBrick& brick, const FactorRows& x,
                            const FactorRows& y, const FactorLines& z, float* sums) {
  constexpr int kSide = SampleBrick::kSide;
  for (Tile tile{0, 0, 0}; tile.y < brick.count[kY]; tile.y += PlaneVector::kPlanes) {
    for (tile.x = 0; tile.x < brick.count[kX]; tile.x += reaching.x_side) {
      const std::uint64_t impulses = reaching.x[tile.x] & reaching.y[tile.y];
      for (tile.z = 0; tile.z < kSide; tile.z += PlaneVector::lanes()) {
        float* const to = sums + (tile.x * kSide + tile.y) * kSide + tile.z;
        if (reaching.x_side == 1) {
          AddTile<1>(x, y, z, impulses, tile, to);
        } else if (reaching.x_side == 4) {
          AddTile<4>(x, y, z, impulses, tile, to);
        } else {
          AddTile<kSide>(x, y, z, impulses, tile, to);
        }
      }
    }
  }
}

// The gradient is made alone where that is `wanted`.
template <class Polynomial, Derivatives kDerivatives>
void SumOrientedBrick(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      Derivatives wanted, BrickSums& sums) {
  constexpr bool kGradient = kDerivatives == Derivatives::gradient;
  std::fill_n(sums.value, SampleBrick::kSamples, 0.0f);
  if constexpr (kGradient) {
    for (auto& gradient : sums.gradient) std::fill_n(gradient, SampleBrick::kSamples, 0.0f);
  }
  ChunkFactors factors;
  ChunkDerivatives derivatives;
  for (std::size_t from = 0; from < list.size(); from += kChunk) {
    const ReachingTiles reaching(sum, list, from, brick);
    MakeFactors<kDerivatives, Polynomial>(sum, list, from, brick, factors, derivatives);
    const auto add = [&](const FactorRows& x, const FactorRows& y, const FactorLines& z, float* to)
                         HWY_ATTR { AddProducts(reaching, brick, x, y, z, to); };
    if (wanted != Derivatives::alone) add(factors.x, factors.y, factors.z, sums.value);
    if constexpr (kGradient) {
      add(derivatives.x, factors.y, factors.z, sums.gradient[kX]);
      add(factors.x, derivatives.y, factors.z, sums.gradient[kY]);
      add(factors.x, factors.y, derivatives.z, sums.gradient[kZ]);
      if (sum.scale[kT] != 0.0f) add(derivatives.time, factors.y, factors.z, sums.gradient[kT]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_ORIENTED_BRICK_INL
