#include "solidnoise/mesh/bake_recipe.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_fields.h"

namespace solidnoise {
namespace {

constexpr double kFeaturesAlongDiagonal = 24.0;

// Those of a bake itself cannot be taken by others.
void require_property_name(const std::string& name) {
  constexpr std::string_view kOwn[] = {"x",   "y",     "z",    "nx",    "ny",   "nz",
                                       "red", "green", "blue", "alpha", "noise"};
  const auto fits = [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  if (name.empty() || !std::ranges::all_of(name, fits) ||
      std::ranges::any_of(kOwn, [&](std::string_view own) { return own == name; })) {
    throw std::invalid_argument(
        fmt::format("properties has {}; a name is letters, digits and underscores, and none of {}",
                    printable(name), fmt::join(kOwn, ", ")));
  }
}

void validate_properties(const BakeRecipe& recipe) {
  NamedLayers known = recipe.fields;
  if (known.contains(kValueField)) {
    throw std::invalid_argument(fmt::format("fields has {}; that is the name of what is baked", kValueField));
  }
  known[kValueField] = {.place = Layer::Place::weight};  // any that is valid stands for it
  for (const auto& [name, layer] : recipe.properties) {
    require_property_name(name);
    validate_layer(layer, {noise_of_layers(recipe.noise), known, LayerSpace::surface, "surface"},
                   "properties." + name);
  }
}

}  // namespace

void BakeRecipe::validate() const {
  noise.validate();
  if (refine.mode == RefineRecipe::Mode::rounds) require_in_range("refine", refine.rounds, 1, 8, "rounds");
  require_fields(*this);
  if (frequency && detail != ParameterRange{}) {
    throw std::invalid_argument("detail has no effect where there is a frequency; leave one of them out");
  }
  if (frequency && feature_size) {
    throw std::invalid_argument(
        "feature_size has no effect where there is a frequency; leave one of them out");
  }
  if (bandwidth.varies() && !has_bandwidth(noise.kind)) {
    throw std::invalid_argument(fmt::format(
        "bandwidth is {}..{}; this noise has one bandwidth for all vertices", bandwidth.from, bandwidth.to));
  }
  validate_layers(layers, {noise_of_layers(noise), fields, LayerSpace::surface, "surface"});
  validate_properties(*this);
  if (noise.time != 0.0 && !changes_with_time()) {
    throw std::invalid_argument(
        fmt::format("time is {}; it must be 0 where dims is 3 and no noise evolves", noise.time));
  }
  by.validate();
  if (glm::length(direction_axis()) == 0.0)
    throw std::invalid_argument("direction is 0 0 0; it must point somewhere");
  if (!has_exemplar_colors()) {
    parse_color_ramp(ramp);
  } else if (noise.kind != SurfaceNoiseKind::spectrum) {
    throw std::invalid_argument("ramp is exemplar; only a noise by example has such colours");
  }
  if (refine.method != RefineOptions::Method::own && refine.placement != RefineOptions::Placement::on_edges) {
    throw std::invalid_argument("refine.placement is smooth; it applies where the method of refining is own");
  }
}

NoiseRecipe noise_of_layers(const SurfaceNoiseRecipe& recipe) {
  return {GaborNoiseOptions{.seed = recipe.seed}, recipe.fractal};
}

Vec<3> BakeRecipe::direction_axis() const {
  return direction.axis.value_or(up == UpAxis::y ? Vec<3>(0.0, 1.0, 0.0) : Vec<3>(0.0, 0.0, 1.0));
}

bool BakeRecipe::changes_with_time() const {
  const auto evolve = [&](const std::vector<Layer>& tree) {
    return std::ranges::any_of(noises_of(tree, noise_of_layers(noise), fields),
                               [](const NoiseRecipe& of_layer) { return evolves(of_layer); });
  };
  return noise.dims == 4 || noise.evolve > 0.0 || evolve(layers) ||
         std::ranges::any_of(properties, [&](const auto& property) { return evolve({property.second}); });
}

bool BakeRecipe::steers() const {
  const auto follows = [&](const std::vector<Layer>& tree) {
    return use_place(tree, Layer::Place::weight, fields);
  };
  return (frequency && frequency->varies()) || detail.varies() || bandwidth.varies() || magnitude.varies() ||
         bias.varies() || follows(layers) ||
         std::ranges::any_of(properties, [&](const auto& property) { return follows({property.second}); });
}

std::uint64_t default_vertex_budget(std::size_t vertices) {
  return std::clamp<std::uint64_t>(4 * std::uint64_t{vertices}, 200'000, 4'000'000);
}

double feature_size_of(const BakeRecipe& recipe, double diagonal) {
  if (recipe.frequency) return 1.0 / std::sqrt(recipe.frequency->from * recipe.frequency->to);
  const double size = recipe.feature_size.value_or(diagonal / kFeaturesAlongDiagonal);
  return size > 0.0 ? size : 1.0;  // any will do where nothing has a size
}

ParameterRange frequencies_of(const BakeRecipe& recipe, double diagonal) {
  if (recipe.frequency) return *recipe.frequency;
  const double size = feature_size_of(recipe, diagonal);
  return {recipe.detail.from / size, recipe.detail.to / size};
}

double smoothing_radius(const BakeRecipe& recipe, const ParameterRange& frequency) {
  constexpr double kFeatures = 1.0;
  return recipe.smooth_radius.value_or(kFeatures / std::min(frequency.from, frequency.to));
}

float place_on_ramp(double value, double contrast) {
  constexpr double kSigmas = 2.5;
  return static_cast<float>(0.5 + 0.5 * contrast * value / kSigmas);
}

}  // namespace solidnoise
