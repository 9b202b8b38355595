#include "vdbnoise/slice_source.h"

#include <utility>
#include <vector>

#include "solidnoise/field/shaped_field.h"

namespace solidnoise {
namespace {

class FieldSource final : public SliceSource {
 public:
  explicit FieldSource(FieldPtr field) : field_(std::move(field)) {}

  void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    std::vector<Vec<3>> positions;
    for (int column = first.x; column < first.x + count.x; ++column) {
      for (int row = first.y; row < first.y + count.y; ++row)
        positions.push_back(plane.position(column, row));
    }
    field_->evaluate({positions}, {values, {}});
  }

  int tile_side() const override { return 32; }

 private:
  FieldPtr field_;
};

class LatticeSource final : public SliceSource {
 public:
  LatticeSource(std::shared_ptr<const Noise<2>> noise, const LatticeFrame<2>& frame, RawShaping::Range range)
      : noise_(std::move(noise)), frame_(frame), range_(range) {}

  void evaluate(const SlicePlane&, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    const Lattice<2> lattice{frame_.origin, frame_.step, Index<2>(first), count};
    noise_->block(lattice.bounds())->evaluate(lattice, Samples<2>{values, {}});
    to_range(range_, values);
  }

  int tile_side() const override { return 128; }

 private:
  std::shared_ptr<const Noise<2>> noise_;
  LatticeFrame<2> frame_;
  RawShaping::Range range_;
};

}  // namespace

std::unique_ptr<SliceSource> make_slice_source(FieldPtr field) {
  return std::make_unique<FieldSource>(std::move(field));
}

std::unique_ptr<SliceSource> make_slice_source(std::shared_ptr<const Noise<2>> noise,
                                               const LatticeFrame<2>& frame, RawShaping::Range range) {
  return std::make_unique<LatticeSource>(std::move(noise), frame, range);
}

}  // namespace solidnoise
