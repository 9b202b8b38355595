#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "solidnoise/core/check.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Where an evaluation writes. `values` has one float per sample for each of a field's channels, one channel
// after the other. `gradient` is either all empty (not wanted) or has, per axis, as many floats as `values`:
// the derivative of the value, per world unit. `gradient_alone`: nobody looks at the values, so that what is
// costly to evaluate may leave 0 there.
template <int Dim>
struct Samples {
  std::span<float> values;
  std::array<std::span<float>, Dim> gradient{};
  bool gradient_alone = false;

  bool wants_gradient() const { return !gradient[0].empty(); }

  // The same with the values, for gradients that depend on these.
  Samples with_values() const { return {values, gradient, false}; }

  // A part of them.
  Samples subspan(std::size_t first, std::size_t count) const {
    Samples part{values.subspan(first, count), {}, gradient_alone};
    if (wants_gradient()) {
      for (std::size_t axis = 0; axis < Dim; ++axis)
        part.gradient[axis] = gradient[axis].subspan(first, count);
    }
    return part;
  }
};

// Throws std::invalid_argument for samples without room for so many numbers.
template <int Dim>
void require_room(const Samples<Dim>& samples, std::size_t needed) {
  require_room("values", samples.values.size(), needed);
  for (std::size_t axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
    require_room("gradient", samples.gradient[axis].size(), needed);
  }
}

template <int Dim>
void fill_with_zero(const Samples<Dim>& samples) {
  std::fill(samples.values.begin(), samples.values.end(), 0.0f);
  for (const auto& derivative : samples.gradient) std::fill(derivative.begin(), derivative.end(), 0.0f);
}

// Memory for samples of the size of others, with a gradient where these want one.
template <int Dim>
class SampleBuffer {
 public:
  explicit SampleBuffer(const Samples<Dim>& like) {
    const std::size_t size = like.values.size();
    memory_ = std::make_unique_for_overwrite<float[]>(size * (like.wants_gradient() ? 1 + Dim : 1));
    samples_.values = {memory_.get(), size};
    samples_.gradient_alone = like.gradient_alone;
    for (std::size_t axis = 0; like.wants_gradient() && axis < Dim; ++axis) {
      samples_.gradient[axis] = {memory_.get() + (axis + 1) * size, size};
    }
  }

  const Samples<Dim>& samples() const { return samples_; }

 private:
  std::unique_ptr<float[]> memory_;
  Samples<Dim> samples_;
};

// An interval of frequencies, cycles per world unit.
struct Band {
  double lower = 0.0;
  double upper = 0.0;
};

// What is known of a field's values in closed form, over all seeds.
struct Statistics {
  double mean = 0.0;
  double variance = 1.0;
  double excess_kurtosis = 0.0;  // E[(n - mean)^4] / variance^2 - 3: 0 for a Gaussian field
  Band band;                     // that holds all but a thousandth of the variance
};

// A field made ready for one box: what is costly to make (the random impulses) is made once, and any lattice
// inside the box is then cheap. It belongs to one thread at a time, for it may keep what it has evaluated.
// The field outlives its blocks.
template <int Dim>
class FieldBlock {
 public:
  virtual ~FieldBlock() = default;

  // Overwrites `samples`, in the lattice's order. Precondition: the lattice lies in the block's box.
  virtual void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const = 0;

  // The samples of several lattices of one size and step, one lattice after the other: for fields that gain
  // by doing many at once. Values are those of evaluate(), to the last bit.
  virtual void evaluate_all(std::span<const Lattice<Dim>> lattices, const Samples<Dim>& samples) const {
    const std::size_t size = lattices.empty() ? 0 : samples.values.size() / lattices.size();
    for (std::size_t i = 0; i < lattices.size(); ++i) {
      evaluate(lattices[i], samples.subspan(i * size, size));
    }
  }
};

// A function of position, with one or more channels: whatever grids, pictures and surfaces are filled with. A
// noise is a field that also knows its statistics; sums, folds, warps, clouds, velocities are fields made of
// fields. Immutable; may be shared between threads. A sample's value depends on the field and the sample's
// position only: not on the batch, block, thread or vector width (vector widths without fused multiply-add
// may differ in the last bits).
template <int Dim>
class Field {
 public:
  virtual ~Field() = default;

  // Values at a sample: 1 for a noise or a density, 3 for a velocity or a colour. They are made in one
  // evaluation, for what costs most, random impulses and kernels, serves all of them.
  virtual int channels() const { return 1; }

  // Whether evaluations may ask for the gradient.
  virtual bool has_gradient() const { return false; }

  // Called once for a group of samples; the place to make what is costly, such as random impulses.
  virtual std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const = 0;

  // Overwrites `samples`, in the order of the points.
  virtual void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const = 0;

  // True if the field is certainly 0 in all of the box, which then is not evaluated. May be pessimistic, must
  // be quick.
  virtual bool empty(const Box<Dim>&) const { return false; }

  // Nothing where they are not known.
  virtual std::optional<Statistics> statistics() const { return std::nullopt; }
};

// Throws std::invalid_argument for samples without room for those of so many positions.
template <int Dim>
void require_room(const Field<Dim>& field, const Samples<Dim>& samples, std::size_t count) {
  require_room(samples, count * static_cast<std::size_t>(field.channels()));
}

// A field of space, shared by the fields that are made of it.
using FieldPtr = std::shared_ptr<const Field<3>>;

}  // namespace solidnoise
