#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/box.h"
#include "solidnoise/core/lattice.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A field made ready for one box. It belongs to one thread at a time.
class FieldBlock {
 public:
  virtual ~FieldBlock() = default;

  // Overwrites `values`: for each of the field's channels one value per sample, in the lattice's order, one
  // channel after the other. Precondition: the lattice lies in the block's box.
  virtual void evaluate(const Lattice<3>& lattice, std::span<float> values) const = 0;

  // The same for several lattices of one frame, one after the other: for fields that gain by doing many at
  // once. Values are the same to the last bit. Precondition: the lattices are of one size.
  virtual void evaluate_all(std::span<const Lattice<3>> lattices, std::span<float> values) const;
};

// Whatever grids can be filled with: a noise, a density shaped from several noises and distances, a velocity.
// Immutable; may be shared between threads. A sample's value depends on the field and the sample's position
// only, never on the block.
class Field {
 public:
  virtual ~Field() = default;

  // Values at a sample: 1 for a density, 3 for a velocity. They are made in one evaluation, for what costs
  // most, random impulses and kernels, serves all of them.
  virtual int channels() const;

  // Called once for a group of voxels; the place to make what is costly, such as random impulses.
  virtual std::unique_ptr<FieldBlock> block(const Box<3>& box) const = 0;

  // True if the field is certainly 0 in all of the box, which then is not evaluated. May be pessimistic, must
  // be quick.
  virtual bool empty(const Box<3>& box) const;
};

// A noise as a field: its values as they are, times `scale`. For a frame of a 4D noise give its slice().
class NoiseField final : public Field {
 public:
  explicit NoiseField(std::shared_ptr<const Noise<3>> noise, double scale = 1.0);

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override;

 private:
  std::shared_ptr<const Noise<3>> noise_;
  float scale_;
};

}  // namespace solidnoise
