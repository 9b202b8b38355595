// Sums of oriented kernels on a brick of samples, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
//
// An oriented kernel is the real part of a product of one complex factor per axis: envelope times wave. On a
// lattice each factor is a small table per impulse, and a sample costs two multiply-adds an impulse.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/oriented_factor-inl.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"
#include "solidnoise/noise/convolution/radial_sum-inl.h"

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

// Impulses are taken 64 at a time: their tables and products fit the nearest cache.
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

// A brick is summed in tiles, a product of matrices each: two vectors of (y, z) samples, all z of a few y, by
// four x. Where two vectors are less than all z of one y, a tile is several times two vectors.
struct ProductTile {
  static constexpr int kX = 4;
  static constexpr int kMaxLanes = 16;
  static constexpr int kMaxSamples = 2 * kMaxLanes;

  // Of constant y in a tile.
  static HWY_INLINE int planes() {
    return std::max(1,
                    static_cast<int>(2 * hn::Lanes(hn::CappedTag<float, kMaxLanes>())) / SampleBrick::kSide);
  }
};

// Calls store(value, sample, impulse) for each of the first `samples` coordinates of an axis, lanes being the
// impulses of the chunk from `from` on.
template <Derivatives kDerivatives, class Polynomial, class Store>
HWY_INLINE void ForEachRow(const OrientedSum& sum, const ImpulseList& list, std::size_t from, Role role,
                           const float* coordinates, int samples, const Store& store) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const typename Polynomial::template Bound<decltype(d)> envelope(d, sum.envelope);
  const V zero = hn::Zero(d);
  const std::size_t count = std::min(kChunk, list.size() - from);
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const V position = hn::LoadU(d, list.position(role) + from + k);
    const V wave = hn::LoadU(d, list.attribute(OrientedSum::wave(role)) + from + k);
    for (int sample = 0; sample < samples; ++sample) {
      AxisFactor<V> along{{hn::Set(d, 1.0f), zero}, {zero, zero}};
      if (sum.scale[role] != 0.0f) {
        along = FactorAlongAxis<kDerivatives>(d, envelope, hn::Sub(hn::Set(d, coordinates[sample]), position),
                                              wave, zero, sum.scale[role]);
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
  const hn::CappedTag<float, SampleBrick::kSide> d;
  const typename Polynomial::template Bound<decltype(d)> envelope(d, sum.envelope);
  const std::size_t count = std::min(kChunk, list.size() - from);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = from + k;
    for (int piece = 0; piece < SampleBrick::kSide; piece += static_cast<int>(hn::Lanes(d))) {
      const auto offset = hn::Sub(hn::Load(d, coordinates + piece), hn::Set(d, list.position(kZ)[i]));
      const auto along = FactorAlongAxis<kDerivatives>(
          d, envelope, offset, hn::Set(d, list.attribute(OrientedSum::wave(kZ))[i]),
          hn::Set(d, list.attribute(OrientedSum::kPhase)[i]), sum.scale[kZ]);
      hn::Store(along.value.re, d, factors.z.re[k] + piece);
      hn::Store(along.value.im, d, factors.z.im[k] + piece);
      if constexpr (kDerivatives == Derivatives::gradient) {
        hn::Store(along.derivative.re, d, derivatives.z.re[k] + piece);
        hn::Store(along.derivative.im, d, derivatives.z.im[k] + piece);
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
      sum, list, from, kX, brick.coordinate[kX], in_tiles(brick.count[kX], ProductTile::kX),
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
                                       in_tiles(brick.count[kY], ProductTile::planes()),
                                       [&](const AxisFactor<V>& along, int sample, std::size_t k) HWY_ATTR {
                                         StoreRow(along.value, factors.y, sample, k);
                                         if constexpr (kGradient)
                                           StoreRow(along.derivative, derivatives.y, sample, k);
                                       });
  MakeLines<kDerivatives, Polynomial>(sum, list, from, brick.coordinate[kZ], factors, derivatives);
}

// Which impulses of a chunk reach which tiles of a brick: bit k is impulse from + k.
struct ReachingTiles {
  ReachingTiles(const OrientedSum& sum, const ImpulseList& list, std::size_t from, const SampleBrick& brick) {
    const auto reaching = [&](Role role, int start, int side) HWY_ATTR {
      const float lower = brick.coordinate[role][start];
      const float upper = brick.coordinate[role][std::min(start + side, brick.count[role]) - 1];
      return SupportBits(from, list.size(), [&](auto d, std::size_t i) HWY_ATTR {
        return SquaredExcess(d, list.position(role) + i, lower, upper, sum.scale[role]);
      });
    };
    for (int start = 0; start < brick.count[kX]; start += ProductTile::kX) {
      x[start / ProductTile::kX] = reaching(kX, start, ProductTile::kX);
    }
    const int planes = ProductTile::planes();
    for (int start = 0; start < brick.count[kY]; start += planes) {
      y[start / planes] = reaching(kY, start, planes);
    }
  }

  std::array<std::uint64_t, SampleBrick::kSide / ProductTile::kX> x;
  std::array<std::uint64_t, SampleBrick::kSide> y;
};

// Calls visit(k) for each set bit k, in order.
template <class Visit>
HWY_INLINE void ForEachBit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

// The products of the y and z factors of a chunk, at the (y, z) samples of one tile.
struct PlaneProducts {
  alignas(64) float re[kChunk][ProductTile::kMaxSamples];
  alignas(64) float im[kChunk][ProductTile::kMaxSamples];
};

HWY_INLINE void MultiplyPlanes(const FactorRows& y, const FactorLines& z, std::uint64_t impulses,
                               int first_plane, PlaneProducts& products) {
  constexpr int kSide = SampleBrick::kSide;
  const hn::CappedTag<float, kSide> d;
  using V = hn::Vec<decltype(d)>;
  const int planes = ProductTile::planes();
  ForEachBit(impulses, [&](std::size_t i) HWY_ATTR {
    for (int piece = 0; piece < kSide; piece += static_cast<int>(hn::Lanes(d))) {
      const Complex<V> line{hn::Load(d, z.re[i] + piece), hn::Load(d, z.im[i] + piece)};
      for (int plane = 0; plane < planes; ++plane) {
        const Complex<V> row{hn::Set(d, y.re[first_plane + plane][i]),
                             hn::Set(d, y.im[first_plane + plane][i])};
        const Complex<V> product = Multiply(row, line);
        hn::Store(product.re, d, products.re[i] + plane * kSide + piece);
        hn::Store(product.im, d, products.im[i] + plane * kSide + piece);
      }
    }
  });
}

// Adds to two vectors of a tile's (y, z) samples, at `sums` and, for each following x, a plane further.
HWY_INLINE void AddVectors(const PlaneProducts& products, std::size_t first, const FactorRows& x, int first_x,
                           std::uint64_t impulses, float* sums) {
  constexpr int kPlane = SampleBrick::kSide * SampleBrick::kSide;
  const hn::CappedTag<float, ProductTile::kMaxLanes> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const auto load = [&](int k, V& low, V& high) HWY_ATTR {
    low = hn::Load(d, sums + k * kPlane);
    high = hn::Load(d, sums + k * kPlane + lanes);
  };
  V low0, low1, low2, low3, high0, high1, high2, high3;
  load(0, low0, high0);
  load(1, low1, high1);
  load(2, low2, high2);
  load(3, low3, high3);
  ForEachBit(impulses, [&](std::size_t i) HWY_ATTR {
    const float* const re = products.re[i] + first;
    const float* const im = products.im[i] + first;
    const Complex<V> low{hn::Load(d, re), hn::Load(d, im)};
    const Complex<V> high{hn::Load(d, re + lanes), hn::Load(d, im + lanes)};
    const auto add = [&](int k, V& low_sum, V& high_sum) HWY_ATTR {
      const Complex<V> factor{hn::Set(d, x.re[first_x + k][i]), hn::Set(d, x.im[first_x + k][i])};
      low_sum = AddRealProduct(low, factor, low_sum);
      high_sum = AddRealProduct(high, factor, high_sum);
    };
    add(0, low0, high0);
    add(1, low1, high1);
    add(2, low2, high2);
    add(3, low3, high3);
  });
  const auto store = [&](int k, V low, V high) HWY_ATTR {
    hn::Store(low, d, sums + k * kPlane);
    hn::Store(high, d, sums + k * kPlane + lanes);
  };
  store(0, low0, high0);
  store(1, low1, high1);
  store(2, low2, high2);
  store(3, low3, high3);
}

// sums += sum over a chunk's impulses of Re(x y z) at every sample of the brick.
HWY_INLINE void AddProducts(const ReachingTiles& reaching, const SampleBrick& brick, const FactorRows& x,
                            const FactorRows& y, const FactorLines& z, float* sums) {
  constexpr int kSide = SampleBrick::kSide;
  const std::size_t two_vectors = 2 * hn::Lanes(hn::CappedTag<float, ProductTile::kMaxLanes>());
  const int planes = ProductTile::planes();
  PlaneProducts products;
  for (int first_y = 0; first_y < brick.count[kY]; first_y += planes) {
    const std::uint64_t impulses = reaching.y[first_y / planes];
    MultiplyPlanes(y, z, impulses, first_y, products);
    for (int first_x = 0; first_x < brick.count[kX]; first_x += ProductTile::kX) {
      for (std::size_t first = 0; first < static_cast<std::size_t>(planes * kSide); first += two_vectors) {
        AddVectors(products, first, x, first_x, impulses & reaching.x[first_x / ProductTile::kX],
                   sums + (first_x * kSide + first_y) * kSide + first);
      }
    }
  }
}

template <class Polynomial, Derivatives kDerivatives>
void SumOrientedBrick(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                      BrickSums& sums) {
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
    add(factors.x, factors.y, factors.z, sums.value);
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
