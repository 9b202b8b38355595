#include "solidnoise/volume/field/layered_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <variant>

#include "solidnoise/volume/field/noise_layer.h"
#include "solidnoise/volume/field/value_maps.h"

namespace solidnoise {
namespace {

using LayerPtr = std::shared_ptr<const LayeredField>;
using Blocks = std::vector<std::unique_ptr<FieldBlock>>;

Blocks blocks_of(std::span<const LayerPtr> layers, const Box<3>& box) {
  Blocks blocks;
  for (const LayerPtr& layer : layers) blocks.push_back(layer->block(box));
  return blocks;
}

// A layer whose values are changed one by one.
class MappedLayer final : public LayeredField {
 public:
  MappedLayer(LayerPtr layer, ValueMap map) : layer_(std::move(layer)), map_(std::move(map)) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<Block>(layer_->block(box), map_);
  }
  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    layer_->evaluate(positions, values);
    map_(values);
  }

 private:
  class Block final : public FieldBlock {
   public:
    Block(std::unique_ptr<FieldBlock> block, const ValueMap& map) : block_(std::move(block)), map_(map) {}

    void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
      block_->evaluate(lattice, values);
      map_(values);
    }

   private:
    std::unique_ptr<FieldBlock> block_;
    const ValueMap& map_;  // the layer's own, which outlives its blocks
  };

  LayerPtr layer_;
  ValueMap map_;
};

// Combines what evaluate(i, values) writes for each of `count` layers, in order.
template <typename Evaluate>
void combine(Layer::Combine how, std::size_t count, std::span<float> values, const Evaluate& evaluate) {
  evaluate(0, values);
  std::vector<float> other(values.size());
  const auto with_each = [&](const auto& of_two) {
    for (std::size_t i = 1; i < count; ++i) {
      evaluate(i, other);
      for (std::size_t j = 0; j < values.size(); ++j) values[j] = of_two(values[j], other[j]);
    }
  };
  switch (how) {
    case Layer::Combine::sum:
      return with_each([](float a, float b) { return a + b; });
    case Layer::Combine::product:
      return with_each([](float a, float b) { return a * b; });
    case Layer::Combine::max:
      return with_each([](float a, float b) { return std::max(a, b); });
    case Layer::Combine::min:
      return with_each([](float a, float b) { return std::min(a, b); });
    case Layer::Combine::mix: {
      std::vector<float> mask(values.size());
      evaluate(1, other);
      evaluate(2, mask);
      for (std::size_t j = 0; j < values.size(); ++j) {
        values[j] += std::clamp(mask[j], 0.0f, 1.0f) * (other[j] - values[j]);
      }
    }
  }
}

class CombinedLayer final : public LayeredField {
 public:
  CombinedLayer(Layer::Combine how, std::vector<LayerPtr> layers) : how_(how), layers_(std::move(layers)) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<Block>(how_, blocks_of(layers_, box));
  }
  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    combine(how_, layers_.size(), values,
            [&](std::size_t i, std::span<float> of_layer) { layers_[i]->evaluate(positions, of_layer); });
  }

 private:
  class Block final : public FieldBlock {
   public:
    Block(Layer::Combine how, Blocks blocks) : how_(how), blocks_(std::move(blocks)) {}

    void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
      combine(how_, blocks_.size(), values,
              [&](std::size_t i, std::span<float> of_layer) { blocks_[i]->evaluate(lattice, of_layer); });
    }

   private:
    Layer::Combine how_;
    Blocks blocks_;
  };

  Layer::Combine how_;
  std::vector<LayerPtr> layers_;
};

std::vector<Vec<3>> positions_of(const Lattice<3>& lattice) {
  std::vector<Vec<3>> positions;
  positions.reserve(lattice.size());
  for (int i = 0; i < lattice.count.x; ++i) {
    for (int j = 0; j < lattice.count.y; ++j) {
      for (int k = 0; k < lattice.count.z; ++k) {
        positions.emplace_back(lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k));
      }
    }
  }
  return positions;
}

// Moves positions by `amount` times what evaluate(axis, values) writes.
template <typename Evaluate>
void displace(std::span<Vec<3>> positions, double amount, const Evaluate& evaluate) {
  std::vector<float> shift(positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    evaluate(static_cast<std::size_t>(axis), shift);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i][axis] += amount * static_cast<double>(shift[i]);
    }
  }
}

class WarpedLayer final : public LayeredField {
 public:
  WarpedLayer(LayerPtr layer, double amount, std::array<LayerPtr, 3> shifts)
      : layer_(std::move(layer)), amount_(amount), shifts_(std::move(shifts)) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, blocks_of(shifts_, box));
  }
  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    std::vector<Vec<3>> moved(positions.begin(), positions.end());
    displace(moved, amount_,
             [&](std::size_t axis, std::span<float> shift) { shifts_[axis]->evaluate(positions, shift); });
    layer_->evaluate(moved, values);
  }

 private:
  class Block final : public FieldBlock {
   public:
    Block(const WarpedLayer& warped, Blocks shifts) : warped_(warped), shifts_(std::move(shifts)) {}

    void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
      std::vector<Vec<3>> moved = positions_of(lattice);
      displace(moved, warped_.amount_,
               [&](std::size_t axis, std::span<float> shift) { shifts_[axis]->evaluate(lattice, shift); });
      warped_.layer_->evaluate(moved, values);
    }

   private:
    const WarpedLayer& warped_;  // outlives its blocks
    Blocks shifts_;
  };

  LayerPtr layer_;
  double amount_;
  std::array<LayerPtr, 3> shifts_;
};

class Builder {
 public:
  Builder(const NoiseRecipe& own, const MakeNoise& make_noise) : own_(own), make_noise_(make_noise) {}

  LayerPtr build(const Layer& layer) const {
    LayerPtr built = layer.layers.empty() ? build_noise(layer) : build_group(layer.combine, layer.layers);
    if (!layer.ramp.empty()) built = std::make_shared<MappedLayer>(built, through_ramp(layer.ramp));
    if (layer.weight != 1.0 || layer.bias != 0.0) {
      built = std::make_shared<MappedLayer>(built, affine(layer.weight, layer.bias));
    }
    return layer.warp && layer.warp->amount > 0.0 ? build_warped(built, *layer.warp) : built;
  }

  LayerPtr build_group(Layer::Combine how, const std::vector<Layer>& layers) const {
    if (layers.size() == 1) return build(layers.front());
    std::vector<LayerPtr> built;
    for (const Layer& layer : layers) built.push_back(build(layer));
    return std::make_shared<CombinedLayer>(how, std::move(built));
  }

 private:
  LayerPtr build_plain(const NoiseRecipe& noise) const {
    const double frequency = std::visit([](const auto& options) { return options.frequency; }, noise.noise);
    const FractalOptions& fractal = noise.fractal;
    return make_noise_layer(make_noise_(noise),
                            frequency * std::pow(fractal.lacunarity, fractal.octaves - 1));
  }

  // Sum of gain^k |n_k|, its sign changed for ridges.
  LayerPtr build_folded_octaves(const NoiseRecipe& noise, double sign) const {
    std::vector<LayerPtr> octaves;
    for (int k = 0; k < noise.fractal.octaves; ++k) {
      const double amplitude = sign * std::pow(noise.fractal.gain, k);
      octaves.push_back(std::make_shared<MappedLayer>(build_plain(octave_of(noise, k)), absolute(amplitude)));
    }
    return std::make_shared<CombinedLayer>(Layer::Combine::sum, std::move(octaves));
  }

  LayerPtr build_noise(const Layer& layer) const {
    const NoiseRecipe noise = noise_of_layer(layer.noise, own_);
    const auto folded = [&]() -> LayerPtr {
      switch (layer.fold) {
        case Layer::Fold::ridged:
          return build_folded_octaves(noise, -1.0);
        case Layer::Fold::turbulence:
          return build_folded_octaves(noise, 1.0);
        case Layer::Fold::billow:
          return std::make_shared<MappedLayer>(build_plain(noise), absolute(1.0));
        case Layer::Fold::none:
          break;
      }
      return build_plain(noise);
    };
    const bool stays = layer.fold == Layer::Fold::none && layer.histogram == Layer::Histogram::gaussian;
    if (stays) return folded();
    return std::make_shared<MappedLayer>(folded(), to_histogram(layer.histogram, layer.fold, noise.fractal));
  }

  LayerPtr build_warped(LayerPtr layer, const Warp& warp) const {
    const NoiseRecipe noise = noise_of_layer(warp.noise, own_);
    std::array<LayerPtr, 3> shifts;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      shifts[axis] = build_plain(channel_of(noise, static_cast<int>(axis)));
    }
    return std::make_shared<WarpedLayer>(std::move(layer), warp.amount, std::move(shifts));
  }

  const NoiseRecipe& own_;
  const MakeNoise& make_noise_;
};

}  // namespace

std::shared_ptr<const LayeredField> make_layered_field(const std::vector<Layer>& layers,
                                                       const NoiseRecipe& own, const MakeNoise& make_noise) {
  if (layers.empty()) throw std::invalid_argument("layers are missing; there must be one at least");
  validate_layers(layers, own);
  return Builder(own, make_noise).build_group(Layer::Combine::sum, layers);
}

}  // namespace solidnoise
