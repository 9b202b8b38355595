#include "solidnoise/volume/field/point_field.h"

#include <array>
#include <utility>
#include <vector>

#include "solidnoise/volume/field/shaped_noise_field.h"

namespace solidnoise {
namespace {

class NoisePointField final : public PointField {
 public:
  NoisePointField(std::shared_ptr<const Noise<3>> noise, const RawShaping& shaping)
      : noise_(std::move(noise)), range_(shaping.range) {}

  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    if (positions.empty()) return;
    std::array<std::vector<float>, 3> offset;
    Points<3> points;
    points.origin = positions.front();
    points.count = positions.size();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float>& of_axis = offset[static_cast<std::size_t>(axis)];
      of_axis.reserve(positions.size());
      for (const Vec<3>& position : positions) {
        of_axis.push_back(static_cast<float>(position[axis] - points.origin[axis]));
      }
      points.offset[static_cast<std::size_t>(axis)] = of_axis.data();
    }
    noise_->evaluate(points, Samples<3>{.values = values});
    to_range(range_, values);
  }

 private:
  std::shared_ptr<const Noise<3>> noise_;
  RawShaping::Range range_;
};

class RangedPointField final : public PointField {
 public:
  RangedPointField(std::shared_ptr<const PointField> field, const RawShaping& shaping)
      : field_(std::move(field)), range_(shaping.range) {}

  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    field_->evaluate(positions, values);
    to_range(range_, values);
  }

 private:
  std::shared_ptr<const PointField> field_;
  RawShaping::Range range_;
};

}  // namespace

std::unique_ptr<PointField> make_point_field(std::shared_ptr<const Noise<3>> noise,
                                             const RawShaping& shaping) {
  return std::make_unique<NoisePointField>(std::move(noise), shaping);
}

std::unique_ptr<PointField> make_point_field(std::shared_ptr<const PointField> field,
                                             const RawShaping& shaping) {
  return std::make_unique<RangedPointField>(std::move(field), shaping);
}

}  // namespace solidnoise
