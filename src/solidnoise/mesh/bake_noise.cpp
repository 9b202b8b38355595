#include "solidnoise/mesh/bake_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/bounds.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/shared_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/surface_field.h"
#include "solidnoise/mesh/vertex_batches.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/point/point_parameters.h"

namespace solidnoise {

void SurfaceNoiseRecipe::validate() const {
  require_fields(*this);
  if (kind == SurfaceNoiseKind::spectrum)
    SpectrumNoiseOptions{.model = exemplar, .channel = channel}.validate();
  if (dims == 4 && kind != SurfaceNoiseKind::solid && kind != SurfaceNoiseKind::kensler_solid) {
    throw std::invalid_argument("dims is 4; it applies to solid and kensler-solid noise, others evolve");
  }
  if (dims == 4 && evolve > 0.0) {
    throw std::invalid_argument("dims is 4; it must be 3 where the noise evolves");
  }
  if (evolve > 0.0 && kind == SurfaceNoiseKind::kensler_solid) {
    throw std::invalid_argument(
        fmt::format("evolve is {}; it must be 0 for kensler-solid noise, which may have dims 4", evolve));
  }
  evolution().validate();
}

bool is_gabor(SurfaceNoiseKind kind) {
  return has_bandwidth(kind) || kind == SurfaceNoiseKind::spectrum;
}

bool has_bandwidth(SurfaceNoiseKind kind) {
  return kind == SurfaceNoiseKind::surface || kind == SurfaceNoiseKind::oriented ||
         kind == SurfaceNoiseKind::solid;
}

bool has_layer(const SurfaceNoiseRecipe& recipe) {
  return recipe.kind == SurfaceNoiseKind::surface || has_direction(recipe);
}

bool has_plane(const SurfaceNoiseRecipe& recipe) {
  return has_layer(recipe) || recipe.kind == SurfaceNoiseKind::kensler;
}

bool has_direction(const SurfaceNoiseRecipe& recipe) {
  if (recipe.kind != SurfaceNoiseKind::spectrum) return recipe.kind == SurfaceNoiseKind::oriented;
  return !recipe.exemplar.channels.empty() && recipe.exemplar.channels.front().dimensions == 2;
}

SurfaceNoiseRecipe channel_of(const SurfaceNoiseRecipe& recipe, int channel) {
  SurfaceNoiseRecipe other = recipe;
  other.channel = channel;
  if (channel > 0) {
    other.seed = derive_seed(recipe.seed, kChannelStream + static_cast<std::uint64_t>(channel));
  }
  return other;
}

namespace {

void require_size(std::string_view name, std::size_t size, std::size_t vertices) {
  if (size == vertices) return;
  throw std::invalid_argument(fmt::format("{} is given for {} vertices; there are {}", name, size, vertices));
}

constexpr Interval kBandwidths = between(0.1, 4.0);  // octaves

void require_number(std::string_view name, const VertexNumber& number, const Interval& allowed,
                    std::size_t vertices) {
  if (!number.varies()) return require(name, number.constant, allowed);
  require_size(name, number.values.size(), vertices);
  for (std::size_t i = 0; i < number.values.size(); ++i) {
    if (allowed.contains(number.values[i])) continue;
    throw std::invalid_argument(fmt::format("{} is {} at vertex {}; it must be from {} to {}", name,
                                            number.values[i], i, allowed.least, allowed.most));
  }
}

void validate(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices) {
  const std::size_t count = vertices.positions.size();
  recipe.validate();
  require_size("normal", vertices.normals.size(), count);
  require_number("frequency", vertices.frequency, kFrequencies, count);
  require_number("bandwidth", vertices.bandwidth, kBandwidths, count);
  require_number("magnitude", vertices.magnitude, between(0.0, 1e12), count);
  if (has_direction(recipe)) require_size("direction", vertices.directions.size(), count);
  if (vertices.bandwidth.varies() && !has_bandwidth(recipe.kind)) {
    throw std::invalid_argument("bandwidth cannot vary: this noise has one for all vertices");
  }
}

VaryingParameter as_parameter(const VertexNumber& number) {
  if (!number.varies()) return {};
  const auto [least, greatest] = std::ranges::minmax(number.values);
  return {std::make_shared<VertexField>(std::vector<std::span<const float>>{number.values}), least, greatest};
}

// What stands for the numbers of all vertices. Where each has its own, the constant may be anything.
double typical(const VertexNumber& number, const Interval& allowed) {
  return number.varies() && !allowed.contains(number.constant) ? 1.0 : number.constant;
}

// The kernel of the noise at the vertices, to whose numbers it refers.
SurfaceKernel kernel_of(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices,
                        const Components& directions) {
  SurfaceKernel kernel{
      typical(vertices.frequency, kFrequencies), typical(vertices.bandwidth, kBandwidths), {}};
  kernel.filter = vertices.filter;
  kernel.fields.unit = vertices.unit;
  kernel.fields.frequency = as_parameter(vertices.frequency);
  kernel.fields.bandwidth = as_parameter(vertices.bandwidth);
  if (has_direction(recipe)) {
    kernel.fields.direction = std::make_shared<VertexField>(
        std::vector<std::span<const float>>{directions[0], directions[1], directions[2]});
  }
  return kernel;
}

LayerNoise own_layer_noise(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel,
                           const Vec<3>& stretch, double turn) {
  if (stretch != Vec<3>(stretch.x)) {
    throw std::invalid_argument(
        "stretch differs from axis to axis in layers with solid noises of their own only");
  }
  if (turn != 0.0 && !has_direction(recipe)) {
    throw std::invalid_argument(
        "turn applies to layers of a noise that has a direction: oriented, or a flat exemplar");
  }
  return surface_layer_noise(recipe, turned(scaled(kernel, 1.0 / stretch.x), turn));
}

// Layers as they are at vertices, to whose numbers they refer. Named fields are made once.
class VertexLayers {
 public:
  VertexLayers(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers, const SurfaceKernel& kernel,
               const BakeVertices& vertices)
      : recipe_(recipe),
        layers_(layers),
        kernel_(kernel),
        vertices_(vertices),
        own_(noise_of_layers(recipe)),
        box_(vertices.bounds ? *vertices.bounds : place_bounds(vertices.positions)) {}

  // What has the name kValueField from here on.
  void set_value(FieldPtr value) { named_[kValueField] = std::move(value); }

  FieldPtr make(const std::vector<Layer>& layers) {
    NamedLayers known = layers_.fields;
    if (named_.contains(kValueField)) known.try_emplace(kValueField, Layer{.place = Layer::Place::weight});
    validate_layers(layers, {own_, known, LayerSpace::surface, "surface"});
    return make_layered_field(layers, leaves());
  }

 private:
  LayerLeaves leaves() {
    return {.noise = [this](const NoiseUse& use) { return noise(use); },
            .named = [this](const std::string& name) { return named(name); },
            .place = [this](Layer::Place place) { return place_of(place); }};
  }

  LayerNoise noise(const NoiseUse& use) const {
    const Vec<3> stretch = use.stretch;
    if (!use.noise) return own_layer_noise(recipe_, kernel_, stretch, use.turn);
    const double filter = kernel_.filter / std::cbrt(stretch.x * stretch.y * stretch.z);
    return layer_noise(noise_of_layer(use.noise, own_), [this, stretch, filter](const NoiseRecipe& solid) {
      return stretched(
          solid_noise_of(recipe_, kernel_.bounds_gradient ? bounding_gradient(solid) : solid, filter),
          stretch);
    });
  }

  FieldPtr named(const std::string& name) {
    if (const auto known = named_.find(name); known != named_.end()) return known->second;
    return named_[name] = share(make_layered_field({layers_.fields.at(name)}, leaves()));
  }

  FieldPtr place_of(Layer::Place place) const {
    if (place != Layer::Place::weight) return place_in(box_, layers_.up, place);
    require_size("weight", vertices_.weights.size(), vertices_.positions.size());
    return std::make_shared<VertexField>(std::vector{vertices_.weights});
  }

  const SurfaceNoiseRecipe& recipe_;
  const SurfaceLayers& layers_;
  const SurfaceKernel& kernel_;
  const BakeVertices& vertices_;
  NoiseRecipe own_;
  Box<3> box_;
  std::map<std::string, FieldPtr> named_;
};

float number_at(const VertexNumber& number, std::size_t vertex) {
  return number.varies() ? number.values[vertex] : static_cast<float>(number.constant);
}

// The noise, or the layers that take its place, times magnitude plus bias.
float magnified(float value, const BakeVertices& vertices, std::size_t vertex) {
  value *= number_at(vertices.magnitude, vertex);
  return value + number_at(vertices.bias, vertex);
}

FieldPtr field_of(const VertexNumber& number, FieldPtr factor) {
  return combine(Layer::Combine::product,
                 {std::move(factor), std::make_shared<VertexField>(std::vector{std::span(number.values)})});
}

// The same of a field; of `vertices`, to whose numbers it refers.
FieldPtr magnified(FieldPtr field, const BakeVertices& vertices) {
  const VertexNumber& magnitude = vertices.magnitude;
  const VertexNumber& bias = vertices.bias;
  field = magnitude.varies() ? field_of(magnitude, std::move(field)) : affine(field, magnitude.constant, 0.0);
  if (!bias.varies()) return affine(field, 1.0, bias.constant);
  const auto added = std::make_shared<VertexField>(std::vector{std::span<const float>(bias.values)});
  return combine(Layer::Combine::sum, {std::move(field), added});
}

// The side of the cubes that vertices are put together in, world units: some wavelengths.
double cube_of(const BakeVertices& vertices) {
  constexpr double kWavelengths = 16.0;
  return kWavelengths / typical(vertices.frequency, kFrequencies);
}

// The part of a field's gradient that is along the surface; without a `step` in closed form, else by
// differences over a step to each side.
std::vector<Vec<3>> slopes_of(const Field<3>& field, const Points<3>& points, double step) {
  const std::size_t count = points.size();
  std::vector<Vec<3>> slopes(count, Vec<3>(0.0));
  std::vector<float> values(count);
  if (step == 0.0) {
    Components gradient;
    for (auto& derivative : gradient) derivative.resize(count);
    field.evaluate(points, {values, {gradient[0], gradient[1], gradient[2]}, true});
    for (std::size_t i = 0; i < count; ++i) {
      const Vec<3> normal = glm::normalize(points.normals[i]);
      const Vec<3> slope(gradient[0][i], gradient[1][i], gradient[2][i]);
      slopes[i] = slope - glm::dot(slope, normal) * normal;
    }
    return slopes;
  }
  std::vector<Vec<3>> moved(count);
  for (const bool across : {false, true}) {
    for (const double sign : {1.0, -1.0}) {
      const auto tangent = [&](std::size_t i) {
        const Vec<3> normal = glm::normalize(points.normals[i]);
        const Vec<3> along = unit_tangent(Vec<3>(1.0, 0.0, 0.0), normal);
        return across ? glm::cross(normal, along) : along;
      };
      for (std::size_t i = 0; i < count; ++i) moved[i] = points.positions[i] + sign * step * tangent(i);
      field.evaluate({moved, points.normals, points.vertices}, {values, {}});
      for (std::size_t i = 0; i < count; ++i) slopes[i] += sign * values[i] / (2.0 * step) * tangent(i);
    }
  }
  return slopes;
}

}  // namespace

Box<3> place_bounds(std::span<const Vec<3>> positions) {
  Box<3> box = bounds_of(positions);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] == box.upper[axis]) box.upper[axis] += 1.0;
  }
  return box;
}

std::vector<float> bake_noise(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices,
                              Progress* progress) {
  return bake_layers(recipe, {}, vertices, progress).values;
}

BakedLayers bake_layers(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                        const BakeVertices& vertices, Progress* progress) {
  validate(recipe, vertices);
  const Components directions = components_of(vertices.directions);
  const SurfaceKernel kernel = kernel_of(recipe, vertices, directions);
  const std::size_t count = vertices.positions.size();
  BakedLayers baked;
  baked.values.resize(count);
  baked.properties.assign(layers.properties.size(), std::vector<float>(count));
  VertexLayers made(recipe, layers, kernel, vertices);
  const FieldPtr value =
      layers.layers.empty() ? make_surface_field(recipe, kernel) : made.make(layers.layers);
  if (const auto statistics = value->statistics()) baked.variance = statistics->variance;
  made.set_value(std::make_shared<VertexField>(std::vector{std::span<const float>(baked.values)}));
  std::vector<FieldPtr> properties;
  for (const Layer& property : layers.properties) properties.push_back(made.make({property}));

  for_each_batch(vertices, cube_of(vertices), progress, [&](const Points<3>& points) {
    std::vector<float> of_batch(points.size());
    const auto evaluate = [&](const Field<3>& field, std::vector<float>& values) {
      field.evaluate(points, {of_batch, {}});
      for (std::size_t i = 0; i < points.size(); ++i) values[points.vertices[i]] = of_batch[i];
    };
    evaluate(*value, baked.values);
    for (const std::uint32_t vertex : points.vertices) {
      baked.values[vertex] = magnified(baked.values[vertex], vertices, vertex);
    }
    for (std::size_t k = 0; k < properties.size(); ++k) evaluate(*properties[k], baked.properties[k]);
  });
  return baked;
}

std::vector<Vec<3>> bake_slopes(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                                const BakeVertices& vertices, bool bounds_gradient, Progress* progress) {
  validate(recipe, vertices);
  const Components directions = components_of(vertices.directions);
  SurfaceKernel kernel = kernel_of(recipe, vertices, directions);
  kernel.bounds_gradient = bounds_gradient;
  VertexLayers made(recipe, layers, kernel, vertices);
  FieldPtr field = magnified(
      layers.layers.empty() ? make_surface_field(recipe, kernel) : made.make(layers.layers), vertices);
  if (!layers.properties.empty()) {
    made.set_value(field);
    field = made.make({layers.properties.front()});
  }
  const bool is_filtered = vertices.filter > 0.0 && !(layers.layers.empty() && layers.properties.empty());
  const double wave = 1.0 / (typical(vertices.frequency, kFrequencies));
  const double step = is_filtered ? vertices.filter : field->has_gradient() ? 0.0 : 0.002 * wave;
  std::vector<Vec<3>> slopes(vertices.positions.size());
  for_each_batch(vertices, cube_of(vertices), progress, [&](const Points<3>& points) {
    const std::vector<Vec<3>> of_batch = slopes_of(*field, points, step);
    for (std::size_t i = 0; i < points.size(); ++i) slopes[points.vertices[i]] = of_batch[i];
  });
  return slopes;
}

Band surface_band(const SurfaceNoiseRecipe& recipe, double frequency, double bandwidth) {
  SurfaceNoiseRecipe endless = recipe;
  endless.loop = 0.0;  // which does not change the band, but does not go with every frequency
  const LayerNoise noise = surface_layer_noise(endless, {frequency, bandwidth, {}});
  return {noise.octave(0)->statistics()->band.lower,
          noise.octave(recipe.fractal.octaves - 1)->statistics()->band.upper};
}

}  // namespace solidnoise
