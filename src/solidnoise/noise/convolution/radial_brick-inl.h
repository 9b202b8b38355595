// Sums of isotropic kernels in bricks of lattices, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/impulse_cull-inl.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"

#if defined(SOLIDNOISE_RADIAL_BRICK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_RADIAL_BRICK_INL
#undef SOLIDNOISE_RADIAL_BRICK_INL
#else
#define SOLIDNOISE_RADIAL_BRICK_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Squared excess (see Excess) of each impulse over an interval of one axis.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V SquaredExcess(D d, const float* positions, float lower, float upper, float scale) {
  const V excess = Excess(d, hn::LoadU(d, positions), lower, upper, scale);
  return hn::Mul(excess, excess);
}

// A brick is summed in columns of 4 x 4 samples in (y, z), and these in pairs of x: small units, for what
// reaches one of them should reach most of its samples. Smaller ones, of single planes, take 5 % longer.
struct Column {
  static constexpr int kY = 4;
  static constexpr int kZ = 4;
  static constexpr int kSamples = kY * kZ;
};
constexpr int kPair = 2;
constexpr int kPairs = SampleBrick::kSide / kPair;

// What the sums need to know of each impulse, computed once per brick or column. Offsets in radii.
class PreparedImpulses {
 public:
  PreparedImpulses(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                   Derivatives derivatives);

  // Makes what depends on y and z for the column that starts at (y, z).
  void enter_column(int y, int z);

  // Bit k: whether impulse `from + k` reaches the column, or the pair of planes of the column.
  std::uint64_t reaching_column(std::size_t from) const;
  std::uint64_t reaching_pair(std::size_t from, int pair) const;

  std::size_t size() const { return list_.size(); }
  const float* x_offset(int x) const { return x_offset_ + static_cast<std::size_t>(x) * stride_; }
  const float* x_squared(int x) const { return x_squared_ + static_cast<std::size_t>(x) * stride_; }
  const float* time_offset() const { return time_offset_; }
  const float* weight() const { return list_.attribute(0); }
  // Per impulse, of the column's samples: 1 minus the squared offset in y, z and time; and the offsets.
  const float* rest(std::size_t i) const { return rest_ + i * Column::kSamples; }
  const float* y_offset(std::size_t i) const { return y_offset_ + i * Column::kSamples; }
  const float* z_offset(std::size_t i) const { return z_offset_ + i * Column::kSamples; }

 private:
  const RadialSum& sum_;
  const ImpulseList& list_;
  const SampleBrick& brick_;
  Derivatives derivatives_;
  std::size_t stride_;
  std::unique_ptr<float[]> memory_;
  float* x_offset_;
  float* x_squared_;
  float* pair_excess_;  // squared, of each pair of planes
  float* time_offset_;
  float* rest_in_time_;   // 1 minus the squared offset in time
  float* column_excess_;  // squared, of the column and the time
  float* rest_;
  float* y_offset_;
  float* z_offset_;
};

inline PreparedImpulses::PreparedImpulses(const RadialSum& sum, const ImpulseList& list,
                                          const SampleBrick& brick, Derivatives derivatives)
    : sum_(sum),
      list_(list),
      brick_(brick),
      derivatives_(derivatives),
      stride_(list.size() + ImpulseList::kPadding) {
  constexpr std::size_t kScalars = 2 * SampleBrick::kSide + kPairs + 3;
  memory_ = std::make_unique_for_overwrite<float[]>((kScalars + 3 * Column::kSamples) * stride_);
  float* next = memory_.get();
  const auto take = [&](std::size_t count) { return std::exchange(next, next + count * stride_); };
  x_offset_ = take(SampleBrick::kSide);
  x_squared_ = take(SampleBrick::kSide);
  pair_excess_ = take(kPairs);
  time_offset_ = take(1);
  rest_in_time_ = take(1);
  column_excess_ = take(1);
  rest_ = take(Column::kSamples);
  y_offset_ = take(Column::kSamples);
  z_offset_ = take(Column::kSamples);

  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const auto offset = [&](float sample, Role role, std::size_t i) HWY_ATTR {
    return hn::Mul(hn::Sub(hn::Set(d, sample), hn::LoadU(d, list.position(role) + i)),
                   hn::Set(d, sum.scale[role]));
  };
  const float* const x = brick.coordinate[kX];
  const int planes_used = (brick.count[kX] + kPair - 1) / kPair * kPair;
  for (std::size_t i = 0; i < list.size(); i += hn::Lanes(d)) {
    for (int k = 0; k < planes_used; ++k) {
      const V x_offset = offset(x[k], kX, i);
      hn::StoreU(x_offset, d, x_offset_ + static_cast<std::size_t>(k) * stride_ + i);
      hn::StoreU(hn::Mul(x_offset, x_offset), d, x_squared_ + static_cast<std::size_t>(k) * stride_ + i);
    }
    for (int pair = 0; pair * kPair < brick.count[kX]; ++pair) {
      const float* const planes = x + pair * kPair;
      hn::StoreU(SquaredExcess(d, list.position(kX) + i, planes[0], planes[kPair - 1], sum.scale[kX]), d,
                 pair_excess_ + static_cast<std::size_t>(pair) * stride_ + i);
    }
    const V time = offset(brick.time, kT, i);
    hn::StoreU(time, d, time_offset_ + i);
    hn::StoreU(hn::Sub(hn::Set(d, 1.0f), hn::Mul(time, time)), d, rest_in_time_ + i);
  }
}

inline void PreparedImpulses::enter_column(int y, int z) {
  const float* const y_samples = brick_.coordinate[kY] + y;
  const float* const z_samples = brick_.coordinate[kZ] + z;
  const hn::CappedTag<float, 16> wide;
  for (std::size_t i = 0; i < size(); i += hn::Lanes(wide)) {
    const auto in_y =
        SquaredExcess(wide, list_.position(kY) + i, y_samples[0], y_samples[Column::kY - 1], sum_.scale[kY]);
    const auto in_z =
        SquaredExcess(wide, list_.position(kZ) + i, z_samples[0], z_samples[Column::kZ - 1], sum_.scale[kZ]);
    const auto in_time = hn::Sub(hn::Set(wide, 1.0f), hn::LoadU(wide, rest_in_time_ + i));
    hn::StoreU(hn::Add(hn::Add(in_y, in_z), in_time), wide, column_excess_ + i);
  }

  const hn::CappedTag<float, Column::kSamples> d;
  using V = hn::Vec<decltype(d)>;
  alignas(64) float y_lanes[Column::kSamples];
  alignas(64) float z_lanes[Column::kSamples];
  for (int k = 0; k < Column::kSamples; ++k) {
    y_lanes[k] = y_samples[k / Column::kZ];
    z_lanes[k] = z_samples[k % Column::kZ];
  }
  const V y_scale = hn::Set(d, sum_.scale[kY]);
  const V z_scale = hn::Set(d, sum_.scale[kZ]);
  for (std::size_t from = 0; from < size(); from += 64) {
    for (std::uint64_t bits = reaching_column(from); bits != 0; bits &= bits - 1) {
      const std::size_t i = from + static_cast<std::size_t>(std::countr_zero(bits));
      for (int piece = 0; piece < Column::kSamples; piece += static_cast<int>(hn::Lanes(d))) {
        const V y_offset =
            hn::Mul(hn::Sub(hn::Load(d, y_lanes + piece), hn::Set(d, list_.position(kY)[i])), y_scale);
        const V z_offset =
            hn::Mul(hn::Sub(hn::Load(d, z_lanes + piece), hn::Set(d, list_.position(kZ)[i])), z_scale);
        const V squared = hn::MulAdd(z_offset, z_offset, hn::Mul(y_offset, y_offset));
        const std::size_t at = i * Column::kSamples + static_cast<std::size_t>(piece);
        hn::StoreU(hn::Sub(hn::Set(d, rest_in_time_[i]), squared), d, rest_ + at);
        if (derivatives_ != Derivatives::none) {
          hn::StoreU(y_offset, d, y_offset_ + at);
          hn::StoreU(z_offset, d, z_offset_ + at);
        }
      }
    }
  }
}

// One bit per impulse from `from` to `from + 63`: whether its squared distance, given per vector, is in the
// support.
template <class SquaredDistance>
HWY_INLINE std::uint64_t SupportBits(std::size_t from, std::size_t size,
                                     const SquaredDistance& squared_distance) {
  const hn::CappedTag<float, 16> d;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < 64 && from + k < size; k += hn::Lanes(d)) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Lt(squared_distance(d, from + k), hn::Set(d, kSupportWithMargin)), bytes);
    bits |= (bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8) << k;
  }
  const std::size_t valid = size - from;
  return valid < 64 ? bits & ((std::uint64_t{1} << valid) - 1) : bits;
}

inline std::uint64_t PreparedImpulses::reaching_column(std::size_t from) const {
  return SupportBits(from, size(),
                     [&](auto d, std::size_t i) HWY_ATTR { return hn::LoadU(d, column_excess_ + i); });
}

inline std::uint64_t PreparedImpulses::reaching_pair(std::size_t from, int pair) const {
  const float* const pair_excess = pair_excess_ + static_cast<std::size_t>(pair) * stride_;
  return SupportBits(from, size(), [&](auto d, std::size_t i) HWY_ATTR {
    return hn::Add(hn::LoadU(d, column_excess_ + i), hn::LoadU(d, pair_excess + i));
  });
}

// Where a pair of planes of a column starts in its brick.
struct Unit {
  int x, y, z;
};

// Sums of one vector of samples: of a plane of the entered column, those from `piece` on.
template <class D, Derivatives kDerivatives>
class VectorSum {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE VectorSum(const PreparedImpulses& prepared, int x, int piece)
      : prepared_(prepared),
        weight_(prepared.weight()),
        x_squared_(prepared.x_squared(x)),
        x_offset_(prepared.x_offset(x)),
        piece_(piece) {}

  template <class Kernel>
  HWY_INLINE void add(const Kernel& kernel, std::size_t i) {
    const D d;
    const V rest = hn::LoadU(d, prepared_.rest(i) + piece_);
    const V t = PositivePart(d, hn::Sub(rest, hn::Set(d, x_squared_[i])));
    const V weight = hn::Set(d, weight_[i]);
    if constexpr (kDerivatives != Derivatives::alone) value_ = kernel.value.add_to(value_, d, t, weight);
    if constexpr (kDerivatives != Derivatives::none) {
      const V slope = kernel.slope.of(d, t, weight);
      gx_ = hn::MulAdd(slope, hn::Set(d, x_offset_[i]), gx_);
      gy_ = hn::MulAdd(slope, hn::LoadU(d, prepared_.y_offset(i) + piece_), gy_);
      gz_ = hn::MulAdd(slope, hn::LoadU(d, prepared_.z_offset(i) + piece_), gz_);
      gt_ = hn::MulAdd(slope, hn::Set(d, prepared_.time_offset()[i]), gt_);
    }
  }

  // `start`: where the plane of the column is in its brick.
  HWY_INLINE void store(const Unit& start, BrickSums& sums) const {
    const D d;
    store_in(value_, start, sums.value);
    if constexpr (kDerivatives != Derivatives::none) {
      const V chain = hn::Set(d, -2.0f);  // d t / d offset = -2 offset
      store_in(hn::Mul(chain, gx_), start, sums.gradient[kX]);
      store_in(hn::Mul(chain, gy_), start, sums.gradient[kY]);
      store_in(hn::Mul(chain, gz_), start, sums.gradient[kZ]);
      store_in(hn::Mul(chain, gt_), start, sums.gradient[kT]);
    }
  }

 private:
  HWY_INLINE void store_in(V sum, const Unit& start, float* to) const {
    const D d;
    alignas(64) float lanes[Column::kSamples];
    hn::Store(sum, d, lanes);
    for (int lane = 0; lane < static_cast<int>(hn::Lanes(d)); ++lane) {
      const int y = start.y + (piece_ + lane) / Column::kZ;
      const int z = start.z + (piece_ + lane) % Column::kZ;
      to[(start.x * SampleBrick::kSide + y) * SampleBrick::kSide + z] = lanes[lane];
    }
  }

  const PreparedImpulses& prepared_;
  const float* weight_;
  const float* x_squared_;
  const float* x_offset_;
  int piece_;
  V value_ = hn::Zero(D());
  V gx_ = hn::Zero(D());
  V gy_ = hn::Zero(D());
  V gz_ = hn::Zero(D());
  V gt_ = hn::Zero(D());
};

// Sums a pair of planes of the entered column: lanes are samples, impulses are the loop. Where a plane is
// more than one vector, two of its vectors are summed at once, so that they share the loop.
template <class Polynomial, Derivatives kDerivatives>
HWY_INLINE void SumUnit(const RadialPolynomial& polynomial, const PreparedImpulses& prepared,
                        const Unit& unit, BrickSums& sums) {
  using Tag = hn::CappedTag<float, Column::kSamples>;
  using Sum = VectorSum<Tag, kDerivatives>;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  // Gradients take all registers that there are.
  constexpr bool kTwo = 2 * kLanes <= Column::kSamples && kDerivatives == Derivatives::none;
  const RadialKernel<kRadialTaper, Polynomial, Tag> kernel(Tag(), polynomial);
  const Unit next{unit.x + 1, unit.y, unit.z};
  for (int piece = 0; piece < Column::kSamples; piece += kTwo ? 2 * kLanes : kLanes) {
    Sum low0(prepared, unit.x, piece), low1(prepared, next.x, piece);
    Sum high0(prepared, unit.x, piece + kLanes), high1(prepared, next.x, piece + kLanes);
    for (std::size_t from = 0; from < prepared.size(); from += 64) {
      for (std::uint64_t bits = prepared.reaching_pair(from, unit.x / kPair); bits != 0; bits &= bits - 1) {
        const std::size_t i = from + static_cast<std::size_t>(std::countr_zero(bits));
        low0.add(kernel, i);
        low1.add(kernel, i);
        if constexpr (kTwo) {
          high0.add(kernel, i);
          high1.add(kernel, i);
        }
      }
    }
    low0.store(unit, sums);
    low1.store(next, sums);
    if constexpr (kTwo) {
      high0.store(unit, sums);
      high1.store(next, sums);
    }
  }
}

template <class Polynomial, Derivatives kDerivatives>
void SumRadialBrick(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                    BrickSums& sums) {
  PreparedImpulses prepared(sum, list, brick, kDerivatives);
  for (int y = 0; y < brick.count[kY]; y += Column::kY) {
    for (int z = 0; z < brick.count[kZ]; z += Column::kZ) {
      prepared.enter_column(y, z);
      for (int x = 0; x < brick.count[kX]; x += kPair) {
        SumUnit<Polynomial, kDerivatives>(sum.kernel, prepared, {x, y, z}, sums);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_RADIAL_BRICK_INL
