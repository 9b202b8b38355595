#include "solidnoise/field/layered_field.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/stretched_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/field/warped_field.h"

namespace solidnoise {
namespace {

class Builder {
 public:
  explicit Builder(const LayerLeaves& leaves) : leaves_(leaves) {}

  FieldPtr build(const Layer& layer) const {
    FieldPtr built = layer.layers.empty() ? build_leaf(layer) : build_group(layer.combine, layer.layers);
    if (!layer.ramp.empty()) built = through_ramp(built, layer.ramp);
    if (layer.weight != 1.0 || layer.bias != 0.0) built = affine(built, layer.weight, layer.bias);
    return layer.warp && layer.warp->amount > 0.0 ? build_warped(built, *layer.warp) : built;
  }

  FieldPtr build_group(Layer::Combine how, const std::vector<Layer>& layers) const {
    std::vector<FieldPtr> built;
    for (const Layer& layer : layers) built.push_back(build(layer));
    return combine(how, std::move(built));
  }

 private:
  // Sum of gain^k |n_k|, its sign changed for ridges.
  static FieldPtr fold_octaves(const LayerNoise& noise, double sign) {
    std::vector<FieldPtr> octaves;
    for (int k = 0; k < noise.fractal.octaves; ++k) {
      octaves.push_back(absolute(noise.octave(k), sign * std::pow(noise.fractal.gain, k)));
    }
    return combine(Layer::Combine::sum, std::move(octaves));
  }

  static FieldPtr fold(const LayerNoise& noise, Layer::Fold fold) {
    switch (fold) {
      case Layer::Fold::ridged:
        return fold_octaves(noise, -1.0);
      case Layer::Fold::turbulence:
        return fold_octaves(noise, 1.0);
      case Layer::Fold::billow:
        return absolute(noise.whole(), 1.0);
      case Layer::Fold::none:
        break;
    }
    return noise.whole();
  }

  FieldPtr build_leaf(const Layer& layer) const {
    if (!layer.use.empty()) return leaves_.named(layer.use);
    if (layer.place != Layer::Place::none) return leaves_.place(layer.place);
    const LayerNoise noise = leaves_.noise(layer.noise, layer.stretch);
    const bool stays = layer.fold == Layer::Fold::none && layer.histogram == Layer::Histogram::gaussian;
    if (stays) return noise.whole();
    return to_histogram(fold(noise, layer.fold), layer.histogram, layer.fold, noise.fractal);
  }

  FieldPtr build_warped(FieldPtr layer, const Warp& warp_of_layer) const {
    const LayerNoise noise = leaves_.noise(warp_of_layer.noise, Vec<3>(1.0));
    return warp(std::move(layer), warp_of_layer.amount,
                {noise.channel(0), noise.channel(1), noise.channel(2)});
  }

  const LayerLeaves& leaves_;
};

}  // namespace

LayerNoise layer_noise(const NoiseRecipe& recipe, const MakeNoise& make_noise) {
  return {recipe.fractal, [=] { return make_noise(recipe); },
          [=](int k) { return make_noise(octave_of(recipe, k)); },
          [=](int axis) { return make_noise(channel_of(recipe, axis)); }};
}

FieldPtr make_layered_field(const std::vector<Layer>& layers, const LayerLeaves& leaves) {
  if (layers.empty()) throw std::invalid_argument("layers are missing; there must be one at least");
  return Builder(leaves).build_group(Layer::Combine::sum, layers);
}

FieldPtr make_layered_field(const std::vector<Layer>& layers, const NoiseRecipe& own,
                            const MakeNoise& make_noise) {
  validate_layers(layers, own);
  LayerLeaves leaves;
  leaves.noise = [&](const std::optional<NoiseRecipe>& noise, const Vec<3>& stretch) {
    return layer_noise(noise_of_layer(noise, own),
                       [=](const NoiseRecipe& recipe) { return stretched(make_noise(recipe), stretch); });
  };
  return make_layered_field(layers, leaves);
}

}  // namespace solidnoise
