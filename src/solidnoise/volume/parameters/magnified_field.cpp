#include "solidnoise/volume/parameters/magnified_field.h"

#include <utility>
#include <vector>

#include "solidnoise/volume/parameters/lattice_positions.h"

namespace solidnoise {
namespace {

void magnify(const ScalarField& magnitude, std::span<const Vec<3>> positions, std::span<float> values) {
  std::vector<float> magnitudes(positions.size());
  magnitude.sample(positions, magnitudes);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= magnitudes[i];
}

class MagnifiedBlock final : public FieldBlock {
 public:
  MagnifiedBlock(std::unique_ptr<FieldBlock> source, const ScalarField& magnitude)
      : source_(std::move(source)), magnitude_(magnitude) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    evaluate_all({&lattice, 1}, values);
  }

  void evaluate_all(std::span<const Lattice<3>> lattices, std::span<float> values) const override {
    source_->evaluate_all(lattices, values);
    std::vector<Vec<3>> positions;
    for (const Lattice<3>& lattice : lattices) append_positions(lattice, positions);
    magnify(magnitude_, positions, values);
  }

 private:
  std::unique_ptr<FieldBlock> source_;
  const ScalarField& magnitude_;  // the field's own, which outlives its blocks
};

class MagnifiedField final : public Field {
 public:
  MagnifiedField(std::shared_ptr<const Field> source, std::shared_ptr<const ParameterFields> fields)
      : source_(std::move(source)), fields_(std::move(fields)) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<MagnifiedBlock>(source_->block(box), *fields_->magnitude());
  }
  bool empty(const Box<3>& box) const override { return source_->empty(box); }

 private:
  std::shared_ptr<const Field> source_;
  std::shared_ptr<const ParameterFields> fields_;
};

class MagnifiedPointField final : public PointField {
 public:
  MagnifiedPointField(std::shared_ptr<const PointField> source, std::shared_ptr<const ParameterFields> fields)
      : source_(std::move(source)), fields_(std::move(fields)) {}

  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    source_->evaluate(positions, values);
    magnify(*fields_->magnitude(), positions, values);
  }

 private:
  std::shared_ptr<const PointField> source_;
  std::shared_ptr<const ParameterFields> fields_;
};

}  // namespace

std::shared_ptr<const Field> with_magnitude(std::shared_ptr<const Field> source,
                                            std::shared_ptr<const ParameterFields> fields) {
  return std::make_shared<MagnifiedField>(std::move(source), std::move(fields));
}

std::shared_ptr<const PointField> with_magnitude(std::shared_ptr<const PointField> source,
                                                 std::shared_ptr<const ParameterFields> fields) {
  return std::make_shared<MagnifiedPointField>(std::move(source), std::move(fields));
}

}  // namespace solidnoise
