#include "solidnoise/field/layered_field.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/crest_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/value_maps.h"

namespace solidnoise {
namespace {

class PlaceField final : public PointwiseField {
 public:
  PlaceField(const Box<3>& box, int vertical, Layer::Place place)
      : box_(box), vertical_(vertical), place_(place) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[i] =
          static_cast<float>(at((points.positions[i] - box_.lower) / (box_.upper - box_.lower)));
    }
  }

 private:
  // `p` is 0 to 1 in the box.
  double at(const Vec<3>& p) const {
    const Vec<3> q = 2.0 * p - 1.0;
    switch (place_) {
      case Layer::Place::x:
        return p.x;
      case Layer::Place::y:
        return p.y;
      case Layer::Place::z:
        return p.z;
      case Layer::Place::height:
        return p[vertical_];
      case Layer::Place::radius:
        return std::hypot(q.x, q[3 - vertical_]);
      case Layer::Place::distance:
      case Layer::Place::weight:
      case Layer::Place::none:
        break;
    }
    return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  }

  Box<3> box_;
  int vertical_;
  Layer::Place place_;
};

}  // namespace

FieldPtr place_in(const Box<3>& box, UpAxis up, Layer::Place place) {
  return std::make_shared<PlaceField>(box, up == UpAxis::y ? 1 : 2, place);
}

namespace {

class Builder {
 public:
  explicit Builder(const LayerLeaves& leaves) : leaves_(leaves) {}

  // `outer`: the amounts of warps of the layers that this one is among.
  FieldPtr build(const Layer& layer, double outer) const {
    const double amount = layer.warp ? layer.warp->amount : 0.0;
    FieldPtr built = layer.layers.empty() ? build_leaf(layer, outer + amount)
                                          : build_group(layer.combine, layer.layers, outer + amount);
    if (!layer.ramp.empty()) built = through_ramp(built, layer.ramp);
    if (layer.weight != 1.0 || layer.bias != 0.0) built = affine(built, layer.weight, layer.bias);
    return amount > 0.0 ? build_warped(built, *layer.warp, outer) : built;
  }

  FieldPtr build_group(Layer::Combine how, const std::vector<Layer>& layers, double warp = 0.0) const {
    std::vector<FieldPtr> built;
    for (const Layer& layer : layers) built.push_back(build(layer, warp));
    return combine(how, std::move(built));
  }

 private:
  // Sum of gain^k |n_k|, its sign changed for ridges.
  static FieldPtr fold_octaves(const LayerNoise& noise, double sign) {
    std::vector<FieldPtr> octaves;
    for (int k = 0; k < noise.fractal.octaves; ++k) {
      octaves.push_back(absolute(noise.octave(k), sign * noise.fractal.amplitude_ratio(k)));
    }
    return combine(Layer::Combine::sum, std::move(octaves));
  }

  static FieldPtr crests(const LayerNoise& noise) {
    std::vector<FieldPtr> octaves;
    for (int k = 0; k < noise.fractal.octaves; ++k) {
      const double ratio = noise.fractal.frequency_ratio(k);
      const FieldPtr frequency =
          noise.varying_frequency ? affine(noise.varying_frequency, ratio, 0.0) : nullptr;
      octaves.push_back(affine(crest_of(noise.octave(k), ratio * noise.frequency, frequency),
                               noise.fractal.amplitude_ratio(k), 0.0));
    }
    const double scale = 1.0 / std::sqrt(noise.fractal.power_of_ratios());
    return affine(combine(Layer::Combine::sum, std::move(octaves)), scale, 0.0);
  }

  static FieldPtr fold(const LayerNoise& noise, Layer::Fold fold) {
    switch (fold) {
      case Layer::Fold::ridged:
        return fold_octaves(noise, -1.0);
      case Layer::Fold::turbulence:
        return fold_octaves(noise, 1.0);
      case Layer::Fold::billow:
        return absolute(noise.whole(), 1.0);
      case Layer::Fold::crest:
        return crests(noise);
      case Layer::Fold::none:
        break;
    }
    return noise.whole();
  }

  FieldPtr build_leaf(const Layer& layer, double warp) const {
    if (!layer.use.empty()) return leaves_.named(layer.use);
    if (layer.place != Layer::Place::none) return leaves_.place(layer.place);
    const LayerNoise noise = leaves_.noise({layer.noise, layer.stretch, layer.turn, warp});
    const bool stays = layer.fold == Layer::Fold::none && layer.histogram == Layer::Histogram::gaussian;
    if (stays) return noise.whole();
    return to_histogram(fold(noise, layer.fold), layer.histogram, layer.fold, noise.fractal);
  }

  FieldPtr build_warped(FieldPtr layer, const Warp& warp_of_layer, double outer) const {
    const LayerNoise noise = leaves_.noise({.noise = warp_of_layer.noise, .warp = outer});
    return warp(std::move(layer), warp_of_layer.amount,
                {noise.channel(0), noise.channel(1), noise.channel(2)});
  }

  const LayerLeaves& leaves_;
};

double frequency_of(const NoiseRecipe& recipe) {
  return std::visit([](const auto& options) { return options.frequency; }, recipe.noise);
}

}  // namespace

LayerNoise layer_noise(const NoiseRecipe& recipe, const MakeNoise& make_noise) {
  return {recipe.fractal, frequency_of(recipe), [=] { return make_noise(recipe); },
          [=](int k) { return make_noise(octave_of(recipe, k)); },
          [=](int axis) { return make_noise(channel_of(recipe, axis)); }};
}

FieldPtr make_layered_field(const std::vector<Layer>& layers, const LayerLeaves& leaves) {
  if (layers.empty()) throw std::invalid_argument("layers are missing; there must be one at least");
  return Builder(leaves).build_group(Layer::Combine::sum, layers);
}

FieldPtr make_layered_field(const std::vector<Layer>& layers, const NoiseRecipe& own,
                            const MakeNoise& make_noise) {
  validate_layers(layers, {own, {}});
  LayerLeaves leaves;
  leaves.noise = [&](const NoiseUse& use) {
    return layer_noise(noise_of_layer(use.noise, own), [=, stretch = use.stretch](const NoiseRecipe& recipe) {
      return stretched(make_noise(recipe), stretch);
    });
  };
  return make_layered_field(layers, leaves);
}

}  // namespace solidnoise
