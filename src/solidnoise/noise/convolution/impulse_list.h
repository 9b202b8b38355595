#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

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
    for (int channel = 0; channel < kChannels; ++channel) {
      float* const to = memory.get() + static_cast<std::size_t>(channel) * stride;
      std::copy_n(memory_.get() + static_cast<std::size_t>(channel) * stride_, size_, to);
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
  int dimensions = 0;
  std::array<int, kRoles> role{};                      // of each axis
  std::array<const std::int32_t*, kRoles> position{};  // of each axis, in 2^-20 of a cell
  std::array<std::int32_t, kRoles> anchor{};           // of each axis: the anchor cell's corner, likewise
  int attributes = 0;
  std::array<const float*, ImpulseList::kMaxAttributes> attribute{};
  std::size_t count = 0;
};

// What culling keeps: impulses whose support meets the samples' bounding box.
struct CullBox {
  enum class Support { ball, box };

  Support support = Support::ball;
  std::array<float, kRoles> lower{};  // per role, in cells from the anchor
  std::array<float, kRoles> upper{};
  std::array<float, kRoles> scale{};  // cells to radii of the support
};

}  // namespace solidnoise
