#include "solidnoise/field/derived_fields.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "solidnoise/field/combined_field.h"

namespace solidnoise {
namespace {

// A field whose channels are made of all those of another, sample by sample: Make has
//   int channels() const;
//   void operator()(std::span<const float> source, std::span<float> values) const;
// both with one channel after the other.
template <typename Make>
class DerivedField final : public Field<3> {
 public:
  DerivedField(FieldPtr source, Make make) : source_(std::move(source)), make_(std::move(make)) {}

  int channels() const override { return make_.channels(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, source_->block(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(*this, samples, points.size());
    std::vector<float> source(memory(points.size()));
    source_->evaluate(points, {source, {}});
    make_(source, samples.values);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const DerivedField& field, std::unique_ptr<FieldBlock<3>> source)
        : field_(field), source_(std::move(source)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      require_room(field_, samples, lattice.size());
      std::vector<float> source(field_.memory(lattice.size()));
      source_->evaluate(lattice, {source, {}});
      field_.make_(source, samples.values);
    }

   private:
    const DerivedField& field_;
    std::unique_ptr<FieldBlock<3>> source_;
  };

  std::size_t memory(std::size_t count) const {
    return static_cast<std::size_t>(source_->channels()) * count;
  }

  FieldPtr source_;
  Make make_;
};

struct Phasor {
  int channels() const { return 2; }
  void operator()(std::span<const float> source, std::span<float> values) const {
    const std::size_t count = source.size() / 2;
    for (std::size_t i = 0; i < count; ++i) {
      const float real = source[i];
      const float imaginary = source[count + i];
      values[i] = std::atan2(imaginary, real);
      values[count + i] = std::sqrt(0.5f * (real * real + imaginary * imaginary));
    }
  }
};

struct ExemplarColors {
  ChannelColors color_of;

  int channels() const { return 3; }
  void operator()(std::span<const float> source, std::span<float> values) const {
    const std::size_t count = values.size() / 3;
    std::vector<double> sample(source.size() / count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < sample.size(); ++k) sample[k] = source[k * count + i];
      const Vec<3> color = color_of(sample);
      for (int c = 0; c < 3; ++c) {
        values[static_cast<std::size_t>(c) * count + i] = static_cast<float>(color[c]);
      }
    }
  }
};

enum class Parts { gradient, value_and_gradient };

class GradientField final : public Field<3> {
 public:
  GradientField(FieldPtr source, Parts parts) : source_(std::move(source)), parts_(parts) {}

  int channels() const override { return parts_ == Parts::gradient ? 3 : 4; }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(source_->block(box), parts_);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    divide(parts_, samples, [&](const Samples<3>& jet) { source_->evaluate(points, jet); });
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(std::unique_ptr<FieldBlock<3>> source, Parts parts) : source_(std::move(source)), parts_(parts) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      divide(parts_, samples, [&](const Samples<3>& jet) { source_->evaluate(lattice, jet); });
    }

   private:
    std::unique_ptr<FieldBlock<3>> source_;
    Parts parts_;
  };

  // Has evaluate() write value and gradient to where the channels are.
  template <typename Evaluate>
  static void divide(Parts parts, const Samples<3>& samples, const Evaluate& evaluate) {
    std::span<float> values = samples.values;
    const std::size_t count = values.size() / (parts == Parts::gradient ? 3 : 4);
    std::vector<float> unwanted(parts == Parts::gradient ? count : 0);
    Samples<3> jet{unwanted, {}, parts == Parts::gradient};
    if (parts == Parts::value_and_gradient) {
      jet.values = values.first(count);
      values = values.subspan(count);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) jet.gradient[axis] = values.subspan(axis * count, count);
    evaluate(jet);
  }

  FieldPtr source_;
  Parts parts_;
};

FieldPtr make_gradient(FieldPtr field, Parts parts) {
  if (!field->has_gradient() || field->channels() != 1) {
    throw std::invalid_argument("a gradient is that of a field of one channel that has one");
  }
  return std::make_shared<GradientField>(std::move(field), parts);
}

}  // namespace

FieldPtr gradient_of(FieldPtr field) {
  return make_gradient(std::move(field), Parts::gradient);
}

FieldPtr value_and_gradient_of(FieldPtr field) {
  return make_gradient(std::move(field), Parts::value_and_gradient);
}

FieldPtr phasor_of(FieldPtr real, FieldPtr imaginary) {
  return std::make_shared<DerivedField<Phasor>>(side_by_side({std::move(real), std::move(imaginary)}),
                                                Phasor{});
}

FieldPtr exemplar_colors_of(std::vector<FieldPtr> noises, const ExemplarModel& model) {
  std::vector<double> variances;
  for (const FieldPtr& noise : noises) {
    const auto statistics = noise->statistics();
    variances.push_back(statistics ? statistics->variance : 1.0);
  }
  return std::make_shared<DerivedField<ExemplarColors>>(side_by_side(std::move(noises)),
                                                        ExemplarColors{ChannelColors(model, variances)});
}

}  // namespace solidnoise
