#include "solidnoise/mesh/bake_noise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_sort.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/surface_field.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"

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
  if (evolve > 0.0 && !is_gabor(kind)) {
    throw std::invalid_argument(fmt::format(
        "evolve is {}; it must be 0 for noise without impulses; kensler-solid may have dims 4", evolve));
  }
  evolution().validate();
}

bool may_vary(SurfaceNoiseKind kind) {
  return has_bandwidth(kind);
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
  if (may_vary(recipe.kind)) return;
  for (const auto& [name, number] :
       {std::pair("frequency", &vertices.frequency), std::pair("bandwidth", &vertices.bandwidth)}) {
    if (number->varies())
      throw std::invalid_argument(fmt::format("{} cannot vary: this noise has one for all vertices", name));
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
  kernel.fields.frequency = as_parameter(vertices.frequency);
  kernel.fields.bandwidth = as_parameter(vertices.bandwidth);
  if (has_direction(recipe)) {
    kernel.fields.direction = std::make_shared<VertexField>(
        std::vector<std::span<const float>>{directions[0], directions[1], directions[2]});
  }
  return kernel;
}

// The least box that holds the vertices, and has a volume.
Box<3> bounds_of(std::span<const Vec<3>> positions) {
  if (positions.empty()) return {Vec<3>(0.0), Vec<3>(1.0)};
  Box<3> box{positions.front(), positions.front()};
  for (const Vec<3>& position : positions) {
    box = {glm::min(box.lower, position), glm::max(box.upper, position)};
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] == box.upper[axis]) box.upper[axis] += 1.0;
  }
  return box;
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

FieldPtr numbers_of(std::string_view name, std::span<const float> numbers, const BakeVertices& vertices) {
  require_size(name, numbers.size(), vertices.positions.size());
  return std::make_shared<VertexField>(std::vector<std::span<const float>>{numbers});
}

// Of `vertices`, to whose numbers it refers.
FieldPtr layered_field(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                       const SurfaceKernel& kernel, const BakeVertices& vertices) {
  const NoiseRecipe own = noise_of_layers(recipe);
  NamedLayers known = layers.fields;
  if (!vertices.values.empty()) known.try_emplace(kValueField, Layer{.place = Layer::Place::weight});
  validate_layers(layers.layers, own, known, LayerSpace::surface);
  const Box<3> box = bounds_of(vertices.positions);
  LayerLeaves leaves;
  leaves.noise = [&](const std::optional<NoiseRecipe>& noise, const Vec<3>& stretch, double turn) {
    if (!noise) return own_layer_noise(recipe, kernel, stretch, turn);
    return layer_noise(noise_of_layer(noise, own), [&recipe, stretch](const NoiseRecipe& solid) {
      return stretched(solid_noise_of(recipe, solid), stretch);
    });
  };
  leaves.named = [&](const std::string& name) {
    const auto named = layers.fields.find(name);
    if (named != layers.fields.end()) return make_layered_field({named->second}, leaves);
    return numbers_of(name, vertices.values, vertices);
  };
  leaves.place = [&](Layer::Place place) {
    if (place == Layer::Place::weight) return numbers_of("weight", vertices.weights, vertices);
    return place_in(box, layers.up, place);
  };
  return make_layered_field(layers.layers, leaves);
}

void magnify(const VertexNumber& magnitude, std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] *= magnitude.varies() ? magnitude.values[i] : static_cast<float>(magnitude.constant);
  }
}

constexpr std::size_t kLargestBatch = 8192;  // vertices of a batch
constexpr double kParts = 8.0;               // along each side of a cube, in whose order its vertices are

// Vertices that are near each other, by index.
using VertexBatch = std::vector<std::uint32_t>;

// Sorts vertices into batches of up to some thousand: those of each cube of a grid, of this side, > 0.
// Positions must be finite.
std::vector<VertexBatch> make_batches(std::span<const Vec<3>> positions, double cube) {
  // In the order of the cubes, and in each in the order of its parts.
  struct Place {
    Vec<3> cube;
    Vec<3> part;
    std::uint32_t vertex;
  };
  const auto memory = std::make_unique_for_overwrite<Place[]>(positions.size());
  const std::span places(memory.get(), positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const Vec<3> scaled = positions[i] / cube;
    const Vec<3> corner = glm::floor(scaled);
    places[i] = {corner, glm::floor((scaled - corner) * kParts), static_cast<std::uint32_t>(i)};
  });
  const auto before = [](const Vec<3>& a, const Vec<3>& b) {
    return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
  };
  tbb::parallel_sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    if (a.cube != b.cube) return before(a.cube, b.cube);
    if (a.part != b.part) return before(a.part, b.part);
    return a.vertex < b.vertex;
  });

  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || places[i].cube != places[i - 1].cube || i - starts.back() == kLargestBatch)
      starts.push_back(i);
  }
  std::vector<VertexBatch> batches(starts.size());
  starts.push_back(places.size());
  tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t k) {
    const auto batch = places.subspan(starts[k], starts[k + 1] - starts[k]);
    batches[k].reserve(batch.size());
    for (const Place& place : batch) batches[k].push_back(place.vertex);
  });
  return batches;
}

// The side of the cubes that vertices are put together in, world units: some wavelengths.
double cube_side(double frequency) {
  constexpr double kWavelengths = 16.0;
  return kWavelengths / frequency;
}

}  // namespace

std::vector<float> bake_noise(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices,
                              Progress* progress) {
  validate(recipe, vertices);
  const Components directions = components_of(vertices.directions);
  const FieldPtr field = make_surface_field(recipe, kernel_of(recipe, vertices, directions));
  std::vector<float> values = bake_field(*field, vertices, progress);
  magnify(vertices.magnitude, values);
  return values;
}

std::vector<float> bake_layers(const SurfaceNoiseRecipe& recipe, const SurfaceLayers& layers,
                               const BakeVertices& vertices, Progress* progress) {
  validate(recipe, vertices);
  const Components directions = components_of(vertices.directions);
  const FieldPtr field = layered_field(recipe, layers, kernel_of(recipe, vertices, directions), vertices);
  std::vector<float> values = bake_field(*field, vertices, progress);
  magnify(vertices.magnitude, values);
  return values;
}

std::vector<float> bake_field(const Field<3>& field, const BakeVertices& vertices, Progress* progress) {
  const std::vector<VertexBatch> batches =
      make_batches(vertices.positions, cube_side(typical(vertices.frequency, kFrequencies)));
  std::vector<float> values(vertices.positions.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for_each(batches, [&](const VertexBatch& batch) {
    throw_if_cancelled(progress);
    std::vector<Vec<3>> positions;
    std::vector<Vec<3>> normals;
    for (const std::uint32_t vertex : batch) {
      positions.push_back(vertices.positions[vertex]);
      normals.push_back(vertices.normals[vertex]);
    }
    std::vector<float> of_batch(batch.size());
    field.evaluate({positions, normals, batch}, {of_batch, {}});
    for (std::size_t i = 0; i < batch.size(); ++i) values[batch[i]] = of_batch[i];
    if (progress) progress->advance(done += batch.size(), values.size());
  });
  return values;
}

Band surface_band(const SurfaceNoiseRecipe& recipe, double frequency, double bandwidth) {
  SurfaceNoiseRecipe endless = recipe;
  endless.loop = 0.0;  // which does not change the band, but does not go with every frequency
  const LayerNoise noise = surface_layer_noise(endless, {frequency, bandwidth, {}});
  return {noise.octave(0)->statistics()->band.lower,
          noise.octave(recipe.fractal.octaves - 1)->statistics()->band.upper};
}

}  // namespace solidnoise
