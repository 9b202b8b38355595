#include "solidnoise/volume/field/noise_layer.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

constexpr int kQuantaPerWaveLog2 = 18;
constexpr double kMostQuanta = 0x1.0p23;  // that a float is sure to hold exactly

double quantum_for(double highest_frequency) {
  return std::exp2(std::floor(-std::log2(highest_frequency)) - kQuantaPerWaveLog2);
}

// Positions as offsets from an origin, which are exact: the positions are multiples of a quantum.
class Batch {
 public:
  explicit Batch(double quantum) : quantum_(quantum) {}

  // False if the position is too far from the others.
  bool add(const Vec<3>& position) {
    Vec<3> rounded;
    for (int axis = 0; axis < 3; ++axis) rounded[axis] = quantum_ * std::nearbyint(position[axis] / quantum_);
    if (size() == 0) origin_ = rounded;
    const Vec<3> offset = rounded - origin_;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(offset[axis]) > kMostQuanta * quantum_) return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      offset_[axis].push_back(static_cast<float>(offset[static_cast<int>(axis)]));
    }
    return true;
  }

  std::size_t size() const { return offset_[0].size(); }
  Points<3> points() const {
    return {origin_, {offset_[0].data(), offset_[1].data(), offset_[2].data()}, size()};
  }
  void clear() {
    for (std::vector<float>& offsets : offset_) offsets.clear();
  }

 private:
  double quantum_;
  Vec<3> origin_{0.0};
  std::array<std::vector<float>, 3> offset_;
};

class NoiseLayer final : public LayeredField {
 public:
  NoiseLayer(std::shared_ptr<const Noise<3>> noise, double quantum)
      : noise_(noise), field_(std::move(noise)), quantum_(quantum) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override { return field_.block(box); }

  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    Batch batch(quantum_);
    const auto flush = [&] {
      noise_->evaluate(batch.points(), Samples<3>{.values = values.first(batch.size())});
      values = values.subspan(batch.size());
      batch.clear();
    };
    for (const Vec<3>& position : positions) {
      if (batch.add(position)) continue;
      flush();
      batch.add(position);
    }
    if (batch.size() > 0) flush();
  }

 private:
  std::shared_ptr<const Noise<3>> noise_;
  NoiseField field_;
  double quantum_;
};

}  // namespace

std::shared_ptr<const LayeredField> make_noise_layer(std::shared_ptr<const Noise<3>> noise,
                                                     double highest_frequency) {
  return std::make_shared<NoiseLayer>(std::move(noise), quantum_for(highest_frequency));
}

}  // namespace solidnoise
