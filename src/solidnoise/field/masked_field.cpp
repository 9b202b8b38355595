#include "solidnoise/field/masked_field.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

// Has evaluate_mask(values) and evaluate(samples) write, and multiplies.
template <typename EvaluateMask, typename Evaluate>
void multiply(std::size_t count, const Samples<3>& samples, const EvaluateMask& evaluate_mask,
              const Evaluate& evaluate) {
  std::vector<float> mask(count);
  evaluate_mask(mask);
  if (std::ranges::all_of(mask, [](float m) { return !(m > 0.0f); })) return fill_with_zero(samples);
  evaluate(samples);
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    samples.values[i] *= std::clamp(mask[i % count], 0.0f, 1.0f);
  }
}

class MaskedField final : public Field<3> {
 public:
  MaskedField(FieldPtr field, FieldPtr mask) : field_(std::move(field)), mask_(std::move(mask)) {}

  int channels() const override { return field_->channels(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(field_->block(box), mask_->block(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    multiply(
        points.size(), samples,
        [&](std::span<float> mask) {
          mask_->evaluate(points, {mask, {}});
        },
        [&](const Samples<3>& of_field) { field_->evaluate(points, of_field); });
  }
  bool empty(const Box<3>& box) const override { return mask_->empty(box) || field_->empty(box); }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(std::unique_ptr<FieldBlock<3>> field, std::unique_ptr<FieldBlock<3>> mask)
        : field_(std::move(field)), mask_(std::move(mask)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      multiply(
          lattice.size(), samples,
          [&](std::span<float> mask) {
            mask_->evaluate(lattice, {mask, {}});
          },
          [&](const Samples<3>& of_field) { field_->evaluate(lattice, of_field); });
    }

   private:
    std::unique_ptr<FieldBlock<3>> field_;
    std::unique_ptr<FieldBlock<3>> mask_;
  };

  FieldPtr field_;
  FieldPtr mask_;
};

}  // namespace

FieldPtr masked(FieldPtr field, FieldPtr mask) {
  if (mask->channels() != 1) throw std::invalid_argument("a mask has one channel");
  return std::make_shared<MaskedField>(std::move(field), std::move(mask));
}

}  // namespace solidnoise
