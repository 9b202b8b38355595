#pragma once

#include <cmath>
#include <cstddef>

#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {

// A field whose values are known: sin(2 pi f.x). It stands in for noises where a test is about what is done
// with them.
class WaveField final : public PointwiseField {
 public:
  // `frequency` in cycles per world unit.
  explicit WaveField(const Vec<3>& frequency) : frequency_(frequency) {}

  float at(const Vec<3>& p) const {
    constexpr double kTwoPi = 6.283185307179586;
    return static_cast<float>(
        std::sin(kTwoPi * (frequency_.x * p.x + frequency_.y * p.y + frequency_.z * p.z)));
  }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) samples.values[i] = at(points.positions[i]);
  }

 private:
  Vec<3> frequency_;
};

}  // namespace solidnoise
