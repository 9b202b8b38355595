#include "solidnoise/field/moved_field.h"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/field/combined_field.h"

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

namespace {

class WarpedField final : public Field<3> {
 public:
  WarpedField(FieldPtr field, double amount, FieldPtr shifts)
      : field_(std::move(field)), amount_(amount), shifts_(std::move(shifts)) {}

  int channels() const override { return field_->channels(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, shifts_->block(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    std::vector<float> shifts(3 * points.size());
    shifts_->evaluate(points, {shifts, {}});
    Points<3> moved = points;
    std::vector<Vec<3>> positions(points.positions.begin(), points.positions.end());
    displace(positions, shifts);
    moved.positions = positions;
    field_->evaluate(moved, samples);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const WarpedField& warped, std::unique_ptr<FieldBlock<3>> shifts)
        : warped_(warped), shifts_(std::move(shifts)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      warped_.field_->evaluate({displaced({&lattice, 1})}, samples);
    }
    // All points at once: one channel has them in the lattices' order.
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (warped_.channels() > 1) return FieldBlock<3>::evaluate_all(lattices, samples);
      warped_.field_->evaluate({displaced(lattices)}, samples);
    }

   private:
    std::vector<Vec<3>> displaced(std::span<const Lattice<3>> lattices) const {
      std::vector<Vec<3>> positions = positions_of(lattices);
      std::vector<float> shifts(3 * positions.size());
      shifts_->evaluate_all(lattices, {shifts, {}});
      const std::size_t size = lattices.empty() ? 0 : positions.size() / lattices.size();
      for (std::size_t first = 0; first < positions.size(); first += size) {
        warped_.displace(std::span(positions).subspan(first, size),
                         std::span(shifts).subspan(3 * first, 3 * size));
      }
      return positions;
    }

    const WarpedField& warped_;
    std::unique_ptr<FieldBlock<3>> shifts_;
  };

  // By shifts along one axis after the other.
  void displace(std::span<Vec<3>> positions, std::span<const float> shifts) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto along = shifts.subspan(static_cast<std::size_t>(axis) * positions.size(), positions.size());
      for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i][axis] += amount_ * static_cast<double>(along[i]);
      }
    }
  }

  FieldPtr field_;
  double amount_;
  FieldPtr shifts_;
};

}  // namespace

FieldPtr warp(FieldPtr field, double amount, const std::array<FieldPtr, 3>& shifts) {
  return std::make_shared<WarpedField>(std::move(field), amount,
                                       side_by_side({shifts.begin(), shifts.end()}));
}

}  // namespace solidnoise
