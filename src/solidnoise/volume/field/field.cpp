#include "solidnoise/volume/field/field.h"

#include <stdexcept>
#include <utility>

namespace solidnoise {
namespace {

class NoiseFieldBlock final : public FieldBlock {
 public:
  NoiseFieldBlock(std::unique_ptr<NoiseBlock<3>> block, float scale)
      : block_(std::move(block)), scale_(scale) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    block_->evaluate(lattice, Samples<3>{.values = values});
    if (scale_ == 1.0f) return;
    for (float& value : values) value *= scale_;
  }

 private:
  std::unique_ptr<NoiseBlock<3>> block_;
  float scale_;
};

}  // namespace

void FieldBlock::evaluate_all(std::span<const Lattice<3>> lattices, std::span<float> values) const {
  for (std::size_t i = 0; i < lattices.size(); ++i) {
    const std::size_t size = values.size() / lattices.size();
    evaluate(lattices[i], values.subspan(i * size, size));
  }
}

int Field::channels() const {
  return 1;
}

bool Field::empty(const Box<3>&) const {
  return false;
}

NoiseField::NoiseField(std::shared_ptr<const Noise<3>> noise, double scale)
    : noise_(std::move(noise)), scale_(static_cast<float>(scale)) {
  if (noise_ == nullptr) throw std::invalid_argument("a noise field needs a noise");
}

std::unique_ptr<FieldBlock> NoiseField::block(const Box<3>& box) const {
  return std::make_unique<NoiseFieldBlock>(noise_->block(box), scale_);
}

}  // namespace solidnoise
