#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "solidnoise/core/field.h"

namespace solidnoise {

// The axes as the summation loops see them, whatever the dimension: up to three spatial ones, right-aligned
// (a 2D noise uses y and z), and time, which is the same for all samples of a brick.
enum Role { kX, kY, kZ, kT, kRoles };

constexpr Role role_of_axis(int dimensions, int axis) {
  const int spatial = dimensions < 3 ? dimensions : 3;
  return static_cast<Role>(axis < 3 ? axis + 3 - spatial : kT);
}

template <int Dim>
constexpr Role role_of_axis(int axis) {
  return role_of_axis(Dim, axis);
}

// The impulses near a few samples, as arrays. Positions are in cells, relative to the samples' anchor cell,
// exact; roles that the noise does not have stay 0. The attributes are what the noise wants to know of each
// impulse.
class ImpulseList {
 public:
  static constexpr int kMaxAttributes = 5;
  static constexpr std::size_t kPadding = 16;  // SIMD stores may write this far past the end

  explicit ImpulseList(int dimensions) {
    for (int axis = 0; axis < dimensions; ++axis) used_[role_of_axis(dimensions, axis)] = true;
  }

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  void set_size(std::size_t size) { size_ = size; }

  // Makes room for `capacity` impulses, keeping those that are there.
  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    const std::size_t stride = std::max(capacity + capacity / 2, kLeast) + kPadding;
    auto memory = std::make_unique_for_overwrite<float[]>(kChannels * stride);
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
      float* const to = memory.get() + channel * stride;
      std::copy_n(memory_.get() + channel * stride_, size_, to);
      if (channel < kRoles && !used_[channel]) std::fill(to, to + stride, 0.0f);
    }
    memory_ = std::move(memory);
    stride_ = stride;
    capacity_ = stride - kPadding;
  }

  float* position(int role) { return memory_.get() + static_cast<std::size_t>(role) * stride_; }
  const float* position(int role) const { return memory_.get() + static_cast<std::size_t>(role) * stride_; }
  float* attribute(int channel) { return position(kRoles + channel); }
  const float* attribute(int channel) const { return position(kRoles + channel); }

 private:
  static constexpr int kChannels = kRoles + kMaxAttributes;
  static constexpr std::size_t kLeast = 384;  // impulses that the first allocation has room for

  std::array<bool, kRoles> used_{};
  std::unique_ptr<float[]> memory_;
  std::size_t size_ = 0;
  std::size_t stride_ = 0;
  std::size_t capacity_ = 0;
};

// A contiguous run of impulses as an impulse block stores them, to be culled into a list.
struct ImpulseRun {
  std::array<const std::int32_t*, kRoles> position{};  // per role, in 2^-20 of a cell
  std::array<std::int32_t, kRoles> anchor{};           // per role: the anchor cell's corner, likewise
  std::array<const float*, ImpulseList::kMaxAttributes> attribute{};
  std::size_t count = 0;
};

// What culling keeps: impulses whose support meets the samples' bounding box.
struct CullBox {
  enum class Support { ball, box };

  int dimensions = 3;
  int attributes = 0;  // of the impulses, that are kept with them
  Support support = Support::ball;
  std::array<float, kRoles> lower{};  // per role, in cells from the anchor
  std::array<float, kRoles> upper{};
  std::array<float, kRoles> scale{};  // cells to radii of the support
};

// Of points with kernels of their own, impulses in a ball.
struct PointCull : CullBox {
  float reach = 1.0f;  // the largest distance of an impulse from a point, in cells
  float span = 1.0f;   // ImpulseProcess::span()
  // The layer around a surface: normal . position from `below` to `above`. Normal 0: no layer.
  std::array<float, 3> normal{};
  float below = 0.0f;
  float above = 0.0f;
  static constexpr int kTurn = 1;  // attribute
  float least_turn = -HUGE_VALF;
  float most_turn = HUGE_VALF;
};

// Up to 8 x 8 x 8 samples on a regular lattice (an OpenVDB leaf), at one time: coordinates per role in cells
// from the anchor cell's corner, exact. Unused entries repeat the last used one.
struct SampleBrick {
  static constexpr int kSide = 8;
  static constexpr int kSamples = kSide * kSide * kSide;

  alignas(64) float coordinate[3][kSide] = {};
  float time = 0.0f;
  std::array<int, 3> count{1, 1, 1};
};

// Up to 16 scattered samples, likewise.
struct SampleCluster {
  static constexpr int kSamples = 16;

  alignas(64) float coordinate[kRoles][kSamples] = {};
  int count = 0;
};

// Sums of a brick (sample (x, y, z) at (x * 8 + y) * 8 + z) or of a cluster, before the noise's amplitude is
// applied; gradients are with respect to offsets in radii of the support.
template <int kSamples>
struct Sums {
  alignas(64) float value[kSamples];
  alignas(64) float gradient[kRoles][kSamples];
};
using BrickSums = Sums<SampleBrick::kSamples>;
using ClusterSums = Sums<SampleCluster::kSamples>;

// What is wanted of a sum. `alone`: the gradient without the values, which may then be 0.
enum class Derivatives { none, gradient, alone };

template <int Dim>
Derivatives derivatives_of(const Samples<Dim>& samples) {
  if (!samples.wants_gradient()) return Derivatives::none;
  return samples.gradient_alone ? Derivatives::alone : Derivatives::gradient;
}

// The vectorised loops of sparse convolution: culling and summation. Each function runs the code of the
// widest instruction set that the processor has. Every sum is taken impulse by impulse in the list's order,
// elementwise per sample, so that its value does not depend on the vector width, the culling or the other
// samples.

// Appends to `list` the impulses of a run, or of another list, that are not out of reach of all samples.
void cull_impulses(const ImpulseRun& run, const CullBox& box, ImpulseList& list);
void cull_impulses(const ImpulseList& impulses, const PointCull& cull, ImpulseList& list);

// P of a CompactKernel in single precision: a sum is w t^k P(v) with t = 1 - s and s the squared distance in
// radii, 0 for s >= 1.
struct RadialPolynomial {
  bool power = true;         // P in powers of v, of an even degree; or t^(k - 2) P in Chebyshev
                             // polynomials of 2 v
  std::vector<float> value;  // coefficients, from degree 0
  std::vector<float> slope;  // likewise, of Q or t^(k - 2) Q: the derivative by t is w t^(k - 1) Q(v)
};

// Sums of an isotropic kernel. Attribute 0 of the list is the impulse's weight.
struct RadialSum {
  static constexpr int kMostDegree = 12;  // in powers, that the sum is compiled for

  std::array<float, kRoles> scale{};  // cells to radii; 0 for roles that the noise does not have
  RadialPolynomial kernel;
};
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                Derivatives derivatives, BrickSums& sums);
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                Derivatives derivatives, ClusterSums& sums);

// Sums of oriented kernels: cos(2 pi (w . d + phase)) times one envelope t^3 P(v) per axis, t = 1 - (d /
// H)^2. Attributes of the list: w along x, y and z in cycles per cell, the phase in cycles, w along t or, of
// impulses that have one, which are in no time, a weight.
struct OrientedSum {
  static constexpr int kMostDegree = 6;  // likewise
  static constexpr int kPhase = 3;       // attributes
  static constexpr int kWeight = 4;
  static constexpr int wave(Role role) { return role == kT ? kPhase + 1 : role; }

  std::array<float, kRoles> scale{};  // cells to half-widths H; 0 for roles that the noise does not have
  RadialPolynomial envelope;
  bool weighted = false;  // else all impulses weigh 1
};
void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                  Derivatives derivatives, BrickSums& sums);
void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                  Derivatives derivatives, ClusterSums& sums);

}  // namespace solidnoise
