#include "solidnoise/field/crest_field.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

class CrestField final : public Field<3> {
 public:
  CrestField(FieldPtr source, double frequency, FieldPtr varying)
      : source_(std::move(source)), frequency_(static_cast<float>(frequency)), varying_(std::move(varying)) {}

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, box);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    divide(
        samples.values, [&](const Samples<3>& jet) { source_->evaluate(points, jet); },
        [&](std::span<float> frequencies) {
          varying_->evaluate(points, {frequencies, {}});
        });
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const CrestField& field, const Box<3>& box)
        : field_(field),
          source_(field.source_->block(box)),
          varying_(field.varying_ ? field.varying_->block(box) : nullptr) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      field_.divide(
          samples.values, [&](const Samples<3>& jet) { source_->evaluate(lattice, jet); },
          [&](std::span<float> frequencies) {
            varying_->evaluate(lattice, {frequencies, {}});
          });
    }

   private:
    const CrestField& field_;
    std::unique_ptr<FieldBlock<3>> source_;
    std::unique_ptr<FieldBlock<3>> varying_;
  };

  template <typename Evaluate, typename Vary>
  void divide(std::span<float> values, const Evaluate& evaluate, const Vary& vary) const {
    constexpr auto kTurn = static_cast<float>(2.0 * std::numbers::pi);
    const std::size_t count = values.size();
    std::vector<float> gradient(3 * count);
    Samples<3> jet{values, {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      jet.gradient[axis] = std::span(gradient).subspan(axis * count, count);
    evaluate(jet);
    std::vector<float> frequencies(varying_ ? count : 0);
    if (varying_) vary(frequencies);
    for (std::size_t i = 0; i < count; ++i) {
      const float turn = kTurn * (varying_ ? frequencies[i] : frequency_);
      const float x = jet.gradient[0][i] / turn;
      const float y = jet.gradient[1][i] / turn;
      const float z = jet.gradient[2][i] / turn;
      const float length = std::sqrt(values[i] * values[i] + x * x + y * y + z * z);
      values[i] = length > 0.0f ? values[i] / length : 0.0f;
    }
  }

  FieldPtr source_;
  float frequency_;
  FieldPtr varying_;
};

}  // namespace

FieldPtr crest_of(FieldPtr field, double frequency, FieldPtr varying) {
  if (!field->has_gradient() || field->channels() != 1) {
    throw std::invalid_argument("crest needs a noise that has a gradient");
  }
  return std::make_shared<CrestField>(std::move(field), frequency, std::move(varying));
}

}  // namespace solidnoise
