#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>

#include "solidnoise/volume/field/field.h"

namespace solidnoise {

// A field whose values are known: sin(2 pi f.x). It stands in for noises where a test is about what is done
// with them.
class WaveField final : public Field {
 public:
  // `frequency` in cycles per world unit.
  explicit WaveField(const Vec<3>& frequency) : frequency_(frequency) {}

  float at(const Vec<3>& p) const {
    constexpr double kTwoPi = 6.283185307179586;
    return static_cast<float>(
        std::sin(kTwoPi * (frequency_.x * p.x + frequency_.y * p.y + frequency_.z * p.z)));
  }

  std::unique_ptr<FieldBlock> block(const Box<3>&) const override { return std::make_unique<Block>(*this); }

 private:
  class Block final : public FieldBlock {
   public:
    explicit Block(const WaveField& field) : field_(field) {}

    void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
      std::size_t sample = 0;
      for (int i = 0; i < lattice.count.x; ++i) {
        for (int j = 0; j < lattice.count.y; ++j) {
          for (int k = 0; k < lattice.count.z; ++k) {
            values[sample++] =
                field_.at({lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k)});
          }
        }
      }
    }

   private:
    const WaveField& field_;
  };

  Vec<3> frequency_;
};

}  // namespace solidnoise
