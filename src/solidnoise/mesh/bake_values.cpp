#include "solidnoise/mesh/bake_values.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/mesh/bake_noise.h"

namespace solidnoise {
namespace {

// Frequencies that the recipe counts in features make the same pattern on a mesh of any size.
BakeVertices vertices_of(const BakePlan& plan, const BakeRecipe& recipe) {
  BakeVertices vertices;
  vertices.positions = plan.mesh.positions;
  vertices.normals = plan.guides.planes();
  vertices.frequency = plan.parameters.frequency;
  vertices.bandwidth = plan.parameters.bandwidth;
  vertices.magnitude = plan.parameters.magnitude;
  vertices.bias = plan.parameters.bias;
  vertices.directions = plan.guides.directions;
  vertices.weights = plan.guides.steering.weights;
  vertices.bounds = plan.bounds;
  vertices.filter = plan.filter;
  if (!recipe.frequency) vertices.unit = plan.feature_size;
  return vertices;
}

const Layer& property_of(const BakeRecipe& recipe, const std::string& name) {
  const auto found = recipe.properties.find(name);
  if (found != recipe.properties.end()) return found->second;
  throw std::invalid_argument(fmt::format("property is {}; the recipe has none of this name", name));
}

// Of a recipe, in world units, with the properties of these names.
SurfaceLayers surface_layers(const BakePlan& plan, const BakeRecipe& recipe,
                             const std::vector<std::string>& properties) {
  SurfaceLayers result{recipe.layers, recipe.up, recipe.fields};
  for (const std::string& name : properties) result.properties.push_back(property_of(recipe, name));
  if (recipe.layer_unit == LayerUnit::world) return result;
  result.layers = in_units(std::move(result.layers), plan.feature_size);
  result.properties = in_units(std::move(result.properties), plan.feature_size);
  for (auto& [name, layer] : result.fields) layer = in_units({layer}, plan.feature_size).front();
  return result;
}

std::vector<Color> ramp_colors(const BakeRecipe& recipe, const std::vector<float>& values) {
  const ColorRamp ramp = parse_color_ramp(recipe.ramp);
  std::vector<Color> colors(values.size());
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
    colors[i] = ramp.linear(place_on_ramp(values[i], recipe.contrast));
  });
  return colors;
}

// The exemplar's own, of its first channel and of the others. Contrast leaves their mean, too.
std::vector<Color> exemplar_colors(const BakePlan& plan, const BakeRecipe& recipe, BakedLayers first,
                                   Progress* progress) {
  const ExemplarModel& exemplar = recipe.noise.exemplar;
  std::vector<BakedLayers> channels{std::move(first)};
  for (std::size_t k = 1; k < exemplar.channels.size(); ++k) {
    channels.push_back(bake_layers(channel_of(recipe.noise, static_cast<int>(k)),
                                   surface_layers(plan, recipe, {}), vertices_of(plan, recipe), progress));
  }
  std::vector<double> variances;
  for (const BakedLayers& channel : channels)
    variances.push_back(recipe.contrast * recipe.contrast * channel.variance);
  const ChannelColors color_of(exemplar, variances);
  std::vector<Color> colors(channels.front().values.size());
  tbb::parallel_for(std::size_t{0}, colors.size(), [&](std::size_t i) {
    std::array<double, 3> values{};
    for (std::size_t k = 0; k < channels.size(); ++k)
      values[k] = recipe.contrast * static_cast<double>(channels[k].values[i]);
    const Color color(color_of(values));
    colors[i] = exemplar.raw_values ? linear_from_srgb(color) : color;
  });
  return colors;
}

std::vector<Vec<3>> height_slopes(const BakePlan& plan, const BakeRecipe& recipe, bool bounds_gradient,
                                  Progress* progress) {
  std::vector<std::string> height;
  if (recipe.properties.contains(kHeightProperty)) height.push_back(kHeightProperty);
  std::vector<Vec<3>> slopes = bake_slopes(recipe.noise, surface_layers(plan, recipe, height),
                                           vertices_of(plan, recipe), bounds_gradient, progress);
  // The noise's plane is smoother than the surface.
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const Vec<3> normal = glm::normalize(plan.guides.normals[i]);
    slopes[i] -= glm::dot(slopes[i], normal) * normal;
  }
  return slopes;
}

}  // namespace

BakedValues bake_values(const BakePlan& plan, const BakeRecipe& recipe, const BakeWishes& wishes,
                        Progress* progress) {
  BakedValues baked;
  BakedLayers layers = bake_layers(recipe.noise, surface_layers(plan, recipe, wishes.properties),
                                   vertices_of(plan, recipe), progress);
  baked.noise = layers.values;
  baked.properties = std::move(layers.properties);
  if (wishes.colors) {
    baked.colors = recipe.has_exemplar_colors() ? exemplar_colors(plan, recipe, std::move(layers), progress)
                                                : ramp_colors(recipe, baked.noise);
  }
  if (wishes.slopes) baked.slopes = height_slopes(plan, recipe, wishes.bounds_gradient, progress);
  return baked;
}

}  // namespace solidnoise
