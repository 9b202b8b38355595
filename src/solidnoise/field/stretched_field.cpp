#include "solidnoise/field/stretched_field.h"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

class StretchedField final : public Field<3> {
 public:
  StretchedField(FieldPtr field, const Vec<3>& stretch) : field_(std::move(field)), stretch_(stretch) {}

  int channels() const override { return field_->channels(); }
  bool has_gradient() const override { return field_->has_gradient(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, field_->block({box.lower / stretch_, box.upper / stretch_}));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    std::vector<Vec<3>> positions(points.positions.begin(), points.positions.end());
    for (Vec<3>& position : positions) position /= stretch_;
    Points<3> looked_up = points;
    looked_up.positions = positions;
    field_->evaluate(looked_up, samples);
    stretch_gradient(samples);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const StretchedField& field, std::unique_ptr<FieldBlock<3>> source)
        : field_(field), source_(std::move(source)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      evaluate_all({&lattice, 1}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      std::vector<Lattice<3>> looked_up(lattices.begin(), lattices.end());
      for (Lattice<3>& lattice : looked_up) {
        lattice.origin /= field_.stretch_;
        lattice.step /= field_.stretch_;
      }
      source_->evaluate_all(looked_up, samples);
      field_.stretch_gradient(samples);
    }

   private:
    const StretchedField& field_;
    std::unique_ptr<FieldBlock<3>> source_;
  };

  void stretch_gradient(const Samples<3>& samples) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto factor = static_cast<float>(1.0 / stretch_[static_cast<int>(axis)]);
      for (float& derivative : samples.gradient[axis]) derivative *= factor;
    }
  }

  FieldPtr field_;
  Vec<3> stretch_;
};

}  // namespace

FieldPtr stretched(FieldPtr field, const Vec<3>& stretch) {
  if (stretch == Vec<3>(1.0)) return field;
  return std::make_shared<StretchedField>(std::move(field), stretch);
}

}  // namespace solidnoise
