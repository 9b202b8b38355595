#include "solidnoise/volume/field/derived_fields.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "solidnoise/volume/field/shaped_noise_field.h"

namespace solidnoise {
namespace {

int channels_of(const std::vector<Output>& outputs) {
  int channels = 0;
  for (const Output output : outputs) channels += components_of(output);
  return channels;
}

class GradientBlock final : public FieldBlock {
 public:
  GradientBlock(std::unique_ptr<NoiseBlock<3>> block, const std::vector<Output>& outputs)
      : block_(std::move(block)), outputs_(outputs) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    const std::size_t size = lattice.size();
    std::vector<float> unwanted;
    Samples<3> samples;
    for (const Output output : outputs_) {
      if (output == Output::value) samples.values = values.first(size);
      for (int axis = 0; output == Output::gradient && axis < 3; ++axis) {
        samples.gradient[axis] = values.subspan(static_cast<std::size_t>(axis) * size, size);
      }
      values = values.subspan(static_cast<std::size_t>(components_of(output)) * size);
    }
    if (samples.values.empty()) {
      unwanted.resize(size);
      samples.values = unwanted;
    }
    block_->evaluate(lattice, samples);
  }

 private:
  std::unique_ptr<NoiseBlock<3>> block_;
  const std::vector<Output>& outputs_;  // the field's own, which outlives its blocks
};

class GradientOfNoise final : public Field {
 public:
  GradientOfNoise(std::shared_ptr<const Noise<3>> noise, const std::vector<Output>& outputs)
      : noise_(std::move(noise)), outputs_(outputs) {}

  int channels() const override { return channels_of(outputs_); }
  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<GradientBlock>(noise_->block(box), outputs_);
  }

 private:
  std::shared_ptr<const Noise<3>> noise_;
  std::vector<Output> outputs_;
};

class PhasorBlock final : public FieldBlock {
 public:
  PhasorBlock(std::unique_ptr<NoiseBlock<3>> real, std::unique_ptr<NoiseBlock<3>> imaginary,
              const std::vector<Output>& outputs)
      : real_(std::move(real)), imaginary_(std::move(imaginary)), outputs_(outputs) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    const std::size_t size = lattice.size();
    std::vector<float> real(size);
    std::vector<float> imaginary(size);
    real_->evaluate(lattice, {real});
    imaginary_->evaluate(lattice, {imaginary});
    for (const Output output : outputs_) {
      for (std::size_t i = 0; i < size; ++i) {
        values[i] = output == Output::phase ? phase(real[i], imaginary[i]) : intensity(real[i], imaginary[i]);
      }
      values = values.subspan(size);
    }
  }

 private:
  static float phase(float real, float imaginary) { return std::atan2(imaginary, real); }
  static float intensity(float real, float imaginary) {
    return std::sqrt(0.5f * (real * real + imaginary * imaginary));
  }

  std::unique_ptr<NoiseBlock<3>> real_;
  std::unique_ptr<NoiseBlock<3>> imaginary_;
  const std::vector<Output>& outputs_;
};

class Phasor final : public Field {
 public:
  Phasor(std::shared_ptr<const Noise<3>> real, std::shared_ptr<const Noise<3>> imaginary,
         const std::vector<Output>& outputs)
      : real_(std::move(real)), imaginary_(std::move(imaginary)), outputs_(outputs) {}

  int channels() const override { return channels_of(outputs_); }
  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<PhasorBlock>(real_->block(box), imaginary_->block(box), outputs_);
  }

 private:
  std::shared_ptr<const Noise<3>> real_;
  std::shared_ptr<const Noise<3>> imaginary_;
  std::vector<Output> outputs_;
};

class ChannelsBlock final : public FieldBlock {
 public:
  explicit ChannelsBlock(std::vector<std::unique_ptr<FieldBlock>> blocks) : blocks_(std::move(blocks)) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    for (const auto& block : blocks_) {
      block->evaluate(lattice, values.first(lattice.size()));
      values = values.subspan(lattice.size());
    }
  }

 private:
  std::vector<std::unique_ptr<FieldBlock>> blocks_;
};

class Channels final : public Field {
 public:
  explicit Channels(std::vector<std::unique_ptr<Field>> fields) : fields_(std::move(fields)) {}

  int channels() const override { return static_cast<int>(fields_.size()); }
  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    std::vector<std::unique_ptr<FieldBlock>> blocks;
    for (const auto& field : fields_) blocks.push_back(field->block(box));
    return std::make_unique<ChannelsBlock>(std::move(blocks));
  }

 private:
  std::vector<std::unique_ptr<Field>> fields_;
};

class ExemplarColorsBlock final : public FieldBlock {
 public:
  ExemplarColorsBlock(std::vector<std::unique_ptr<NoiseBlock<3>>> blocks, const ExemplarModel& model)
      : blocks_(std::move(blocks)), model_(model) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    const std::size_t size = lattice.size();
    std::vector<float> noises(blocks_.size() * size);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      blocks_[k]->evaluate(lattice, {std::span(noises).subspan(k * size, size)});
    }
    std::vector<double> sample(blocks_.size());
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < sample.size(); ++k) sample[k] = noises[k * size + i];
      const Vec<3> color = model_.color(sample);
      for (int c = 0; c < 3; ++c) {
        values[static_cast<std::size_t>(c) * size + i] = static_cast<float>(color[c]);
      }
    }
  }

 private:
  std::vector<std::unique_ptr<NoiseBlock<3>>> blocks_;
  const ExemplarModel& model_;  // the field's own, which outlives its blocks
};

class ExemplarColors final : public Field {
 public:
  ExemplarColors(std::vector<std::shared_ptr<const Noise<3>>> noises, const ExemplarModel& model)
      : noises_(std::move(noises)), model_(model) {}

  int channels() const override { return 3; }
  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    std::vector<std::unique_ptr<NoiseBlock<3>>> blocks;
    for (const auto& noise : noises_) blocks.push_back(noise->block(box));
    return std::make_unique<ExemplarColorsBlock>(std::move(blocks), model_);
  }

 private:
  std::vector<std::shared_ptr<const Noise<3>>> noises_;
  ExemplarModel model_;
};

}  // namespace

std::unique_ptr<Field> make_gradient_field(std::shared_ptr<const Noise<3>> noise,
                                           const std::vector<Output>& outputs) {
  validate_outputs(outputs);
  return std::make_unique<GradientOfNoise>(std::move(noise), outputs);
}

std::unique_ptr<Field> make_phasor_field(std::shared_ptr<const Noise<3>> real,
                                         std::shared_ptr<const Noise<3>> imaginary,
                                         const std::vector<Output>& outputs) {
  validate_outputs(outputs);
  return std::make_unique<Phasor>(std::move(real), std::move(imaginary), outputs);
}

std::unique_ptr<Field> make_channels_field(const std::vector<std::shared_ptr<const Noise<3>>>& noises,
                                           const RawShaping& range) {
  std::vector<std::unique_ptr<Field>> fields;
  for (const auto& noise : noises) fields.push_back(make_field(noise, range));
  return std::make_unique<Channels>(std::move(fields));
}

std::unique_ptr<Field> make_exemplar_colors(std::vector<std::shared_ptr<const Noise<3>>> noises,
                                            const ExemplarModel& model) {
  return std::make_unique<ExemplarColors>(std::move(noises), model);
}

}  // namespace solidnoise
