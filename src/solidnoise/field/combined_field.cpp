#include "solidnoise/field/combined_field.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

using Blocks = std::vector<std::unique_ptr<FieldBlock<3>>>;

Blocks blocks_of(std::span<const FieldPtr> fields, const Box<3>& box) {
  Blocks blocks;
  for (const FieldPtr& field : fields) blocks.push_back(field->block(box));
  return blocks;
}

// Two values become one, of these derivatives by the first and by the second.
struct Partials {
  float first;
  float second;
};
struct Sum {
  static float value(float a, float b) { return a + b; }
  static Partials partials(float, float) { return {1.0f, 1.0f}; }
};
struct Product {
  static float value(float a, float b) { return a * b; }
  static Partials partials(float a, float b) { return {b, a}; }
};
struct Maximum {
  static float value(float a, float b) { return std::max(a, b); }
  static Partials partials(float a, float b) { return a < b ? Partials{0.0f, 1.0f} : Partials{1.0f, 0.0f}; }
};
struct Minimum {
  static float value(float a, float b) { return std::min(a, b); }
  static Partials partials(float a, float b) { return b < a ? Partials{0.0f, 1.0f} : Partials{1.0f, 0.0f}; }
};

template <typename OfTwo>
void add(const Samples<3>& to, const Samples<3>& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < to.gradient[axis].size(); ++i) {
      const Partials by = OfTwo::partials(to.values[i], other.values[i]);
      to.gradient[axis][i] = by.first * to.gradient[axis][i] + by.second * other.gradient[axis][i];
    }
  }
  for (std::size_t i = 0; i < to.values.size(); ++i)
    to.values[i] = OfTwo::value(to.values[i], other.values[i]);
}

void mix(const Samples<3>& to, const Samples<3>& other, const Samples<3>& mask) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < to.gradient[axis].size(); ++i) {
      const float m = mask.values[i];
      const float of_mask = m > 0.0f && m < 1.0f ? mask.gradient[axis][i] : 0.0f;
      to.gradient[axis][i] += std::clamp(m, 0.0f, 1.0f) * (other.gradient[axis][i] - to.gradient[axis][i]) +
                              (other.values[i] - to.values[i]) * of_mask;
    }
  }
  for (std::size_t i = 0; i < to.values.size(); ++i) {
    to.values[i] += std::clamp(mask.values[i], 0.0f, 1.0f) * (other.values[i] - to.values[i]);
  }
}

// Combines what evaluate(i, samples) writes for each of `count` fields, in order.
template <typename Evaluate>
void combine_samples(Layer::Combine how, std::size_t count, const Samples<3>& wanted,
                     const Evaluate& evaluate) {
  const Samples<3> samples = how == Layer::Combine::sum ? wanted : wanted.with_values();
  evaluate(0, samples);
  if (count == 1) return;
  const SampleBuffer<3> other(samples);
  const auto with_each = [&](const auto& of_two) {
    for (std::size_t i = 1; i < count; ++i) {
      evaluate(i, other.samples());
      of_two(samples, other.samples());
    }
  };
  switch (how) {
    case Layer::Combine::sum:
      return with_each(add<Sum>);
    case Layer::Combine::product:
      return with_each(add<Product>);
    case Layer::Combine::max:
      return with_each(add<Maximum>);
    case Layer::Combine::min:
      return with_each(add<Minimum>);
    case Layer::Combine::mix: {
      const SampleBuffer<3> mask(samples);
      evaluate(1, other.samples());
      evaluate(2, mask.samples());
      mix(samples, other.samples(), mask.samples());
    }
  }
}

class CombinedField final : public Field<3> {
 public:
  CombinedField(Layer::Combine how, std::vector<FieldPtr> fields) : how_(how), fields_(std::move(fields)) {}

  int channels() const override { return fields_.front()->channels(); }
  bool has_gradient() const override {
    return std::ranges::all_of(fields_, [](const FieldPtr& field) { return field->has_gradient(); });
  }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(how_, blocks_of(fields_, box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    combine_samples(how_, fields_.size(), samples, [&](std::size_t i, const Samples<3>& of_field) {
      fields_[i]->evaluate(points, of_field);
    });
  }
  bool empty(const Box<3>& box) const override {
    const auto is_empty = [&](const FieldPtr& field) { return field->empty(box); };
    return how_ == Layer::Combine::product ? std::ranges::any_of(fields_, is_empty)
                                           : std::ranges::all_of(fields_, is_empty);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(Layer::Combine how, Blocks blocks) : how_(how), blocks_(std::move(blocks)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      evaluate_all({&lattice, 1}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      combine_samples(how_, blocks_.size(), samples, [&](std::size_t i, const Samples<3>& of_field) {
        blocks_[i]->evaluate_all(lattices, of_field);
      });
    }

   private:
    Layer::Combine how_;
    Blocks blocks_;
  };

  Layer::Combine how_;
  std::vector<FieldPtr> fields_;
};

class SideBySide final : public Field<3> {
 public:
  explicit SideBySide(std::vector<FieldPtr> fields) : fields_(std::move(fields)) {}

  int channels() const override {
    int sum = 0;
    for (const FieldPtr& field : fields_) sum += field->channels();
    return sum;
  }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, box);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(*this, samples, points.size());
    std::size_t done = 0;
    for (const FieldPtr& field : fields_) {
      const std::size_t size = static_cast<std::size_t>(field->channels()) * points.size();
      field->evaluate(points, samples.subspan(done, size));
      done += size;
    }
  }
  bool empty(const Box<3>& box) const override {
    return std::ranges::all_of(fields_, [&](const FieldPtr& field) { return field->empty(box); });
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const SideBySide& field, const Box<3>& box)
        : field_(field), blocks_(blocks_of(field.fields_, box)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      evaluate_all({&lattice, 1}, samples);
    }
    // Without gradients.
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (lattices.empty()) return;
      require_room(field_, samples, lattices.size() * lattices.front().size());
      const std::size_t stride = samples.values.size() / lattices.size();
      const std::size_t channel = lattices.front().size();
      std::size_t first = 0;  // of the field's values among those of a lattice
      std::vector<float> values;
      for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const std::size_t size = static_cast<std::size_t>(field_.fields_[i]->channels()) * channel;
        values.resize(lattices.size() * size);
        blocks_[i]->evaluate_all(lattices, {values, {}});
        for (std::size_t k = 0; k < lattices.size(); ++k) {
          std::ranges::copy(std::span(values).subspan(k * size, size),
                            samples.values.subspan(k * stride + first, size).begin());
        }
        first += size;
      }
    }

   private:
    const SideBySide& field_;
    Blocks blocks_;
  };

  std::vector<FieldPtr> fields_;
};

}  // namespace

FieldPtr combine(Layer::Combine how, std::vector<FieldPtr> fields) {
  if (fields.empty()) throw std::invalid_argument("there are no fields to combine");
  for (const FieldPtr& field : fields) {
    if (field->channels() != fields.front()->channels()) {
      throw std::invalid_argument("fields that are combined must have the same number of channels");
    }
  }
  if (fields.size() == 1) return fields.front();
  return std::make_shared<CombinedField>(how, std::move(fields));
}

FieldPtr side_by_side(std::vector<FieldPtr> fields) {
  if (fields.empty()) throw std::invalid_argument("there are no fields to put side by side");
  return std::make_shared<SideBySide>(std::move(fields));
}

namespace {

// Has evaluate_mask(values) and evaluate(samples) write `parts` parts of `count` positions each, and
// multiplies all channels of each part.
template <typename EvaluateMask, typename Evaluate>
void multiply(std::size_t count, std::size_t parts, const Samples<3>& samples,
              const EvaluateMask& evaluate_mask, const Evaluate& evaluate) {
  std::vector<float> mask(count * parts);
  evaluate_mask(mask);
  if (std::ranges::all_of(mask, [](float m) { return !(m > 0.0f); })) return fill_with_zero(samples);
  evaluate(samples);
  const std::size_t stride = samples.values.size() / parts;
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    const float m = mask[i / stride * count + i % stride % count];
    samples.values[i] = m > 0.0f ? samples.values[i] * std::min(m, 1.0f) : 0.0f;
  }
}

class MaskedField final : public Field<3> {
 public:
  MaskedField(FieldPtr field, FieldPtr mask) : field_(std::move(field)), mask_(std::move(mask)) {}

  int channels() const override { return field_->channels(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, box);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(*this, samples, points.size());
    multiply(
        points.size(), 1, samples,
        [&](std::span<float> mask) {
          mask_->evaluate(points, {mask, {}});
        },
        [&](const Samples<3>& of_field) { field_->evaluate(points, of_field); });
  }
  bool empty(const Box<3>& box) const override { return mask_->empty(box) || field_->empty(box); }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const MaskedField& masked, const Box<3>& box)
        : masked_(masked), field_(masked.field_->block(box)), mask_(masked.mask_->block(box)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      evaluate_all({&lattice, 1}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (lattices.empty()) return;
      require_room(masked_, samples, lattices.size() * lattices.front().size());
      multiply(
          lattices.front().size(), lattices.size(), samples,
          [&](std::span<float> mask) {
            mask_->evaluate_all(lattices, {mask, {}});
          },
          [&](const Samples<3>& of_field) { field_->evaluate_all(lattices, of_field); });
    }

   private:
    const MaskedField& masked_;
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
