#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/core/field.h"

namespace solidnoise {

// A field that gains nothing by lattices: it is evaluated at the positions of their samples.
class PointwiseField : public Field<3> {
 public:
  std::unique_ptr<FieldBlock<3>> block(const Box<3>&) const override {
    return std::make_unique<Block>(*this);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    explicit Block(const PointwiseField& field) : field_(field) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      field_.evaluate({positions_of({&lattice, 1})}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (field_.channels() > 1) return FieldBlock<3>::evaluate_all(lattices, samples);
      field_.evaluate({positions_of(lattices)}, samples);
    }

   private:
    const PointwiseField& field_;
  };
};

// A field whose values are changed one by one. A Map has
//   float operator()(float value) const;
//   float slope(float value) const;  // its derivative
template <typename Map>
class MappedField final : public Field<3> {
 public:
  MappedField(FieldPtr source, Map map) : source_(std::move(source)), map_(std::move(map)) {}

  int channels() const override { return source_->channels(); }
  bool has_gradient() const override { return source_->has_gradient(); }

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(source_->block(box), map_);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    source_->evaluate(points, samples.with_values());
    apply(map_, samples);
  }

 private:
  static void apply(const Map& map, const Samples<3>& samples) {
    for (const std::span<float> derivative : samples.gradient) {
      for (std::size_t i = 0; i < derivative.size(); ++i) derivative[i] *= map.slope(samples.values[i]);
    }
    for (float& value : samples.values) value = map(value);
  }

  class Block final : public FieldBlock<3> {
   public:
    Block(std::unique_ptr<FieldBlock<3>> source, const Map& map) : source_(std::move(source)), map_(map) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      source_->evaluate(lattice, samples.with_values());
      apply(map_, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      source_->evaluate_all(lattices, samples.with_values());
      apply(map_, samples);
    }

   private:
    std::unique_ptr<FieldBlock<3>> source_;
    const Map& map_;
  };

  FieldPtr source_;
  Map map_;
};

template <typename Map>
FieldPtr map_field(FieldPtr source, Map map) {
  return std::make_shared<MappedField<Map>>(std::move(source), std::move(map));
}

// A field of one channel whose values are changed by their places, which count by a sum of what they are
// along each axis. Without a gradient. A Map has
//   double along(int axis, double coordinate) const;
//   float operator()(float value, double sum) const;
//   bool empty(const Box<3>& box) const;  // see Field
template <typename Map>
class PlacedField final : public Field<3> {
 public:
  PlacedField(FieldPtr source, Map map) : source_(std::move(source)), map_(std::move(map)) {}

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(source_->block(box), map_);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    source_->evaluate(points, samples);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3>& p = points.positions[i];
      samples.values[i] =
          map_(samples.values[i], map_.along(0, p.x) + map_.along(1, p.y) + map_.along(2, p.z));
    }
  }
  bool empty(const Box<3>& box) const override { return map_.empty(box); }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(std::unique_ptr<FieldBlock<3>> source, const Map& map) : source_(std::move(source)), map_(map) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      source_->evaluate(lattice, samples);
      apply(lattice, samples.values);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      source_->evaluate_all(lattices, samples);
      std::span<float> values = samples.values;
      for (const Lattice<3>& lattice : lattices) {
        apply(lattice, values.first(lattice.size()));
        values = values.subspan(lattice.size());
      }
    }

   private:
    void apply(const Lattice<3>& lattice, std::span<float> values) const {
      std::array<std::vector<double>, 3> along;
      for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < lattice.count[axis]; ++i) {
          along[static_cast<std::size_t>(axis)].push_back(map_.along(axis, lattice.coordinate(axis, i)));
        }
      }
      float* value = values.data();
      for (const double x : along[0]) {
        for (const double y : along[1]) {
          for (const double z : along[2]) {
            *value = map_(*value, x + y + z);
            ++value;
          }
        }
      }
    }

    std::unique_ptr<FieldBlock<3>> source_;
    const Map& map_;
  };

  FieldPtr source_;
  Map map_;
};

}  // namespace solidnoise
