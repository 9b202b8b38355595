#include "solidnoise/field/layer.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/choices.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kLayerStream = 0x6c61796572;  // "layer"

// What layers are made of has unit variance. `prefix` is the noise's place in the tree, with a dot.
void require_unit_variance(const std::string& prefix, const NoiseRecipe& noise) {
  if (noise.fractal.octaves > 1 && !noise.fractal.renormalize) {
    throw std::invalid_argument(prefix +
                                "renormalize is false; it must be true in a layer, which has a weight");
  }
  const auto filter_of = [](const auto& options) {
    if constexpr (requires { options.filter; }) {
      return options.filter;
    } else {
      return 0.0;
    }
  };
  const double filter = std::visit(filter_of, noise.noise);
  if (filter != 0.0)
    throw std::invalid_argument(fmt::format("{}filter is {}; it must be 0 in a layer", prefix, filter));
}

void validate_noise(const std::string& path, const std::optional<NoiseRecipe>& noise,
                    const LayerScope& scope) {
  if (!noise) return require_unit_variance(scope.path_of_own + ".", scope.own);
  in_field(path + ".noise.", [&] { noise->validate(); });
  require_unit_variance(path + ".noise.", *noise);
}

void refuse_without_effect(const std::string& path, const char* key, bool given, const char* where) {
  if (given) throw std::invalid_argument(fmt::format("{}.{} has no effect {}", path, key, where));
}

void validate_ramp(const std::string& path, const std::vector<Vec<2>>& ramp) {
  if (ramp.empty()) return;
  if (ramp.size() < 2) throw std::invalid_argument(path + ".ramp has 1 stop; it must have at least 2");
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    const std::string stop = fmt::format("{}.ramp[{}]", path, i);
    require_finite(stop, ramp[i].x);
    require_finite(stop, ramp[i].y);
    if (i > 0 && !(ramp[i].x > ramp[i - 1].x)) {
      throw std::invalid_argument(fmt::format("{} is at {}; it must be beyond the stop before it, {}", stop,
                                              ramp[i].x, ramp[i - 1].x));
    }
  }
}

std::string listed(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

class Validation {
 public:
  explicit Validation(const LayerScope& scope) : scope_(scope) {}

  void visit_all(const std::string& path, const std::vector<Layer>& layers, int depth) {
    for (std::size_t i = 0; i < layers.size(); ++i) visit(fmt::format("{}[{}]", path, i), layers[i], depth);
  }

  void visit(const std::string& path, const Layer& layer, int depth) {
    if (depth > kDeepestLayer) {
      throw std::invalid_argument(
          fmt::format("{} is at level {}; layers can be {} deep", path, depth, kDeepestLayer));
    }
    if (++count_ > kMostLayers) {
      throw std::invalid_argument(
          fmt::format("{} is one too many; there can be {} layers", path, kMostLayers));
    }
    layer.layers.empty() ? validate_leaf(path, layer, depth) : validate_group(path, layer);
    validate_ramp(path, layer.ramp);
    require_finite(path + ".weight", layer.weight);
    require_finite(path + ".bias", layer.bias);
    if (layer.warp) {
      require_in_range(path + ".warp.amount", layer.warp->amount, 0.0, 1e9, "world units");
      validate_noise(path + ".warp", layer.warp->noise, scope_);
    }
    visit_all(path + ".layers", layer.layers, depth + 1);
  }

 private:
  void validate_leaf(const std::string& path, const Layer& layer, int depth) {
    refuse_without_effect(path, "combine", layer.combine != Layer::Combine::sum, "without layers");
    for (int axis = 0; axis < 3; ++axis) require_positive(path + ".stretch", layer.stretch[axis]);
    require_in_range(path + ".turn", layer.turn, -360.0, 360.0, "degrees");
    if (layer.noise || scope_.space == LayerSpace::volume) {
      refuse_without_effect(path, "turn", layer.turn != 0.0, "but on a surface's oriented noise");
    }
    if (scope_.space == LayerSpace::volume && layer.place == Layer::Place::weight) {
      throw std::invalid_argument(path + ".place is weight; only the noise of a surface is steered");
    }
    if (layer.use.empty() && layer.place == Layer::Place::none) return validate_noise_leaf(path, layer);
    const char* const where = layer.use.empty() ? "on a place" : "on a named field";
    refuse_without_effect(path, "place", !layer.use.empty() && layer.place != Layer::Place::none, where);
    refuse_noise_fields(path, layer, where);
    if (!layer.use.empty()) visit_named(path, layer.use, depth);
  }

  void visit_named(const std::string& path, const std::string& name, int depth) {
    const auto named = scope_.fields.find(name);
    if (named == scope_.fields.end()) refuse_name(path, name);
    const auto before = std::find(used_.begin(), used_.end(), name);
    const auto first = static_cast<std::size_t>(before - used_.begin());
    used_.push_back(name);
    if (first + 1 < used_.size()) {
      const std::string circle = listed(std::span(used_).subspan(first));
      throw std::invalid_argument(fmt::format("{}.use is {}; fields must not use each other in a circle: {}",
                                              path, printable(name), printable(circle)));
    }
    visit("fields." + name, named->second, depth + 1);
    used_.pop_back();
  }

  [[noreturn]] void refuse_name(const std::string& path, const std::string& name) const {
    std::vector<std::string_view> known;
    for (const auto& [field, layer] : scope_.fields) known.push_back(field);
    constexpr std::size_t kMostListed = 400;  // bytes
    const std::string_view nearest = nearest_word(name, known);
    const std::string names = printable(listed(known), kMostListed);
    throw std::invalid_argument(
        fmt::format("{}.use is {}; it must be {}{}", path, printable(name),
                    known.empty() ? "left out where there are no fields" : "one of " + names,
                    nearest.empty() ? "" : fmt::format("; did you mean {}?", printable(nearest))));
  }

  static void refuse_noise_fields(const std::string& path, const Layer& layer, const char* where) {
    refuse_without_effect(path, "noise", layer.noise.has_value(), where);
    refuse_without_effect(path, "fold", layer.fold != Layer::Fold::none, where);
    refuse_without_effect(path, "histogram", layer.histogram != Layer::Histogram::gaussian, where);
    refuse_without_effect(path, "stretch", layer.stretch != Vec<3>(1.0), where);
    refuse_without_effect(path, "turn", layer.turn != 0.0, where);
  }

  void validate_noise_leaf(const std::string& path, const Layer& layer) const {
    validate_noise(path, layer.noise, scope_);
    const bool sums = layer.fold != Layer::Fold::none && layer.fold != Layer::Fold::billow;
    const int octaves = layer.noise.value_or(scope_.own).fractal.octaves;
    if (layer.histogram == Layer::Histogram::uniform && sums && octaves > 1) {
      throw std::invalid_argument(fmt::format(
          "{}.histogram is uniform; it must be gaussian where {} octaves are folded one by one, whose "
          "distribution has no closed form",
          path, octaves));
    }
  }

  void validate_group(const std::string& path, const Layer& layer) const {
    constexpr char kWhere[] = "on a layer that combines others";
    refuse_noise_fields(path, layer, kWhere);
    refuse_without_effect(path, "use", !layer.use.empty(), kWhere);
    refuse_without_effect(path, "place", layer.place != Layer::Place::none, kWhere);
    if (layer.combine == Layer::Combine::mix && layer.layers.size() != 3) {
      throw std::invalid_argument(
          fmt::format("{}.layers has {}; mix takes 3: from, to and mask", path, layer.layers.size()));
    }
  }

  const LayerScope& scope_;
  std::vector<std::string_view> used_;  // fields that are being visited
  int count_ = 0;
};

bool is_noise(const Layer& layer) {
  return layer.layers.empty() && layer.use.empty() && layer.place == Layer::Place::none;
}

// Calls visit(layer) with every layer, in order, those of named fields where they are used.
template <typename Visit>
void for_each_layer(const std::vector<Layer>& layers, const NamedLayers& named, const Visit& visit) {
  for (const Layer& layer : layers) {
    const auto used = named.find(layer.use);
    if (used != named.end()) for_each_layer({used->second}, named, visit);
    visit(layer);
    for_each_layer(layer.layers, named, visit);
  }
}

// Calls visit(noise) with the noise of every leaf and warp, in order.
template <typename Visit>
void for_each_noise(const std::vector<Layer>& layers, const NamedLayers& named, const Visit& visit) {
  for_each_layer(layers, named, [&](const Layer& layer) {
    if (is_noise(layer)) visit(layer.noise);
    if (layer.warp) visit(layer.warp->noise);
  });
}

void scale(std::optional<NoiseRecipe>& noise, double unit) {
  if (!noise) return;
  std::visit(
      [&](auto& options) {
        options.frequency /= unit;
        for (int axis = 0; axis < 3; ++axis) options.period[axis] *= unit;
      },
      noise->noise);
}

}  // namespace

void validate_layers(const std::vector<Layer>& layers, const LayerScope& scope, const std::string& path) {
  Validation(scope).visit_all(path, layers, 1);
}

void validate_layer(const Layer& layer, const LayerScope& scope, const std::string& path) {
  Validation(scope).visit(path, layer, 1);
}

NoiseRecipe noise_of_layer(const std::optional<NoiseRecipe>& noise, const NoiseRecipe& own) {
  if (!noise) return own;
  NoiseRecipe mixed = *noise;
  const std::uint64_t key = derive_seed(seed_of(own), kLayerStream);
  std::visit([&](auto& options) { options.seed = derive_seed(key, options.seed); }, mixed.noise);
  return mixed;
}

std::vector<NoiseRecipe> noises_of(const std::vector<Layer>& layers, const NoiseRecipe& own,
                                   const NamedLayers& named) {
  std::vector<NoiseRecipe> noises;
  for_each_noise(layers, named, [&](const std::optional<NoiseRecipe>& noise) {
    noises.push_back(noise_of_layer(noise, own));
  });
  return noises;
}

bool use_own_noise(const std::vector<Layer>& layers, const NamedLayers& named) {
  bool used = false;
  for_each_noise(layers, named, [&](const std::optional<NoiseRecipe>& noise) { used = used || !noise; });
  return used;
}

bool use_place(const std::vector<Layer>& layers, Layer::Place place, const NamedLayers& named) {
  bool used = false;
  for_each_layer(layers, named, [&](const Layer& layer) { used = used || layer.place == place; });
  return used;
}

double finest_frequency(const std::vector<Layer>& layers, const NamedLayers& named) {
  double finest = 0.0;
  for_each_layer(layers, named, [&](const Layer& layer) {
    if (!layer.noise) return;
    const auto frequency_of = [](const auto& options) { return options.frequency; };
    finest = std::max(finest, std::visit(frequency_of, layer.noise->noise));
  });
  return finest;
}

double largest_warp(const std::vector<Layer>& layers, const NamedLayers& named) {
  double largest = 0.0;
  for_each_layer(layers, named, [&](const Layer& layer) {
    if (layer.warp) largest = std::max(largest, layer.warp->amount);
  });
  return largest;
}

std::vector<Layer> in_units(std::vector<Layer> layers, double unit) {
  for (Layer& layer : layers) {
    scale(layer.noise, unit);
    if (layer.warp) {
      layer.warp->amount *= unit;
      scale(layer.warp->noise, unit);
    }
    layer.layers = in_units(std::move(layer.layers), unit);
  }
  return layers;
}

}  // namespace solidnoise
