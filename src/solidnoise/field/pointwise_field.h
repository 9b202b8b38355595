#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/field.h"

namespace solidnoise {

// A field that gains nothing by lattices: it is evaluated at the positions of their samples.
class PointwiseField : public Field<3> {
 public:
  std::unique_ptr<FieldBlock<3>> block(const Box<3>&) const override {
    return std::make_unique<Block>(*this);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    explicit Block(const PointwiseField& field) : field_(field) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      field_.evaluate({positions_of({&lattice, 1})}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (field_.channels() > 1) return FieldBlock<3>::evaluate_all(lattices, samples);
      field_.evaluate({positions_of(lattices)}, samples);
    }

   private:
    const PointwiseField& field_;
  };
};

}  // namespace solidnoise
