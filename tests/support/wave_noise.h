#pragma once

#include <cmath>
#include <cstddef>
#include <memory>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise whose values are known: sqrt(2) sin(2 pi k.x), of unit variance over space. It stands in for the
// real ones where a test is about what is done with a noise.
class WaveNoise final : public Noise<3> {
 public:
  explicit WaveNoise(const Vec<3>& frequency) : frequency_(frequency) {}

  float at(const Vec<3>& p) const {
    constexpr double kTwoPi = 6.283185307179586;
    return static_cast<float>(
        std::sqrt(2.0) * std::sin(kTwoPi * (frequency_.x * p.x + frequency_.y * p.y + frequency_.z * p.z)));
  }

  using Noise<3>::evaluate;
  std::unique_ptr<NoiseBlock<3>> block(const Box<3>&) const override {
    return std::make_unique<Block>(*this);
  }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.count; ++i) {
      samples.values[i] = at({points.coordinate(i, 0), points.coordinate(i, 1), points.coordinate(i, 2)});
    }
  }

  double variance() const override { return 1.0; }
  double power_spectrum(const Vec<3>&) const override { return 0.0; }
  double excess_kurtosis() const override { return -1.5; }
  Band band() const override {
    const double f =
        std::sqrt(frequency_.x * frequency_.x + frequency_.y * frequency_.y + frequency_.z * frequency_.z);
    return {f, f};
  }

 private:
  class Block final : public NoiseBlock<3> {
   public:
    explicit Block(const WaveNoise& noise) : noise_(noise) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      std::size_t sample = 0;
      for (int i = 0; i < lattice.count.x; ++i) {
        for (int j = 0; j < lattice.count.y; ++j) {
          for (int k = 0; k < lattice.count.z; ++k) {
            samples.values[sample++] =
                noise_.at({lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k)});
          }
        }
      }
    }

   private:
    const WaveNoise& noise_;
  };

  Vec<3> frequency_;
};

}  // namespace solidnoise
