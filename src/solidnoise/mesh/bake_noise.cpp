#include "solidnoise/mesh/bake_noise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/mesh/surface_octave.h"
#include "solidnoise/mesh/vertex_batches.h"
#include "solidnoise/noise/convolution/kernel_cells.h"

namespace solidnoise {
namespace {

void require_size(std::string_view name, std::size_t size, std::size_t vertices) {
  if (size == vertices) return;
  throw std::invalid_argument(fmt::format("{} is given for {} vertices; there are {}", name, size, vertices));
}

void require_number(std::string_view name, const VertexNumber& number, double least, double most,
                    std::size_t vertices) {
  require_in_range(name, number.constant, least, most);
  if (!number.varies()) return;
  require_size(name, number.values.size(), vertices);
  for (std::size_t i = 0; i < number.values.size(); ++i) {
    if (number.values[i] >= least && number.values[i] <= most) continue;
    throw std::invalid_argument(fmt::format("{} is {} at vertex {}; it must be from {} to {}", name,
                                            number.values[i], i, least, most));
  }
}

void validate(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices) {
  const std::size_t count = vertices.positions.size();
  recipe.validate();
  require_size("normal", vertices.normals.size(), count);
  require_number("frequency", vertices.frequency, 1e-12, 1e12, count);
  require_number("bandwidth", vertices.bandwidth, 0.1, 4.0, count);
  require_number("magnitude", vertices.magnitude, 0.0, 1e12, count);
  if (has_direction(recipe)) require_size("direction", vertices.directions.size(), count);
  if (may_vary(recipe.kind)) return;
  for (const auto& [name, number] :
       {std::pair("frequency", &vertices.frequency), std::pair("bandwidth", &vertices.bandwidth)}) {
    if (number->varies())
      throw std::invalid_argument(fmt::format("{} cannot vary: this noise has one for all vertices", name));
  }
}

// A batch's share of the vertices' data, in the form that the noises take.
class GatheredBatch {
 public:
  GatheredBatch(const BakeVertices& vertices, const VertexBatch& batch, bool oriented) {
    const std::size_t count = batch.vertices.size();
    const auto gather = [&](std::array<std::vector<float>, 3>& to, const auto& vector_of) {
      for (int axis = 0; axis < 3; ++axis) {
        to[static_cast<std::size_t>(axis)].resize(count);
        for (std::size_t i = 0; i < count; ++i) {
          to[static_cast<std::size_t>(axis)][i] = static_cast<float>(vector_of(batch.vertices[i])[axis]);
        }
      }
    };
    gather(offset_, [&](std::uint32_t vertex) { return vertices.positions[vertex] - batch.origin; });
    gather(normal_, [&](std::uint32_t vertex) { return vertices.normals[vertex]; });
    if (oriented) gather(direction_, [&](std::uint32_t vertex) { return vertices.directions[vertex]; });
    const auto pick = [&](std::vector<float>& to, const VertexNumber& number) {
      if (!number.varies()) return;
      for (const std::uint32_t vertex : batch.vertices) to.push_back(number.values[vertex]);
    };
    pick(frequency_, vertices.frequency);
    pick(bandwidth_, vertices.bandwidth);
    points_.positions.origin = batch.origin;
    points_.positions.count = count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points_.positions.offset[axis] = offset_[axis].data();
      points_.normal[axis] = normal_[axis];
    }
  }

  const SurfacePoints& points() const { return points_; }

  // With frequencies times `ratio`.
  VaryingParameters<3> parameters(double ratio) {
    scaled_.resize(frequency_.size());
    std::transform(frequency_.begin(), frequency_.end(), scaled_.begin(),
                   [&](float frequency) { return static_cast<float>(ratio * frequency); });
    VaryingParameters<3> parameters;
    parameters.frequency = scaled_;
    parameters.bandwidth = bandwidth_;
    for (std::size_t axis = 0; axis < 3; ++axis) parameters.direction[axis] = direction_[axis];
    return parameters;
  }

 private:
  std::array<std::vector<float>, 3> offset_;
  std::array<std::vector<float>, 3> normal_;
  std::array<std::vector<float>, 3> direction_;
  std::vector<float> frequency_;
  std::vector<float> scaled_;
  std::vector<float> bandwidth_;
  SurfacePoints points_;
};

struct WeightedOctave {
  std::unique_ptr<SurfaceOctave> noise;
  double ratio = 1.0;  // of its frequency to that of the first
  double amplitude = 1.0;
};

std::vector<WeightedOctave> make_octaves(const SurfaceNoiseRecipe& recipe, double frequency,
                                         double bandwidth) {
  const FractalOptions& fractal = recipe.fractal;
  double power = 0.0;
  for (int k = 0; k < fractal.octaves; ++k) power += std::pow(fractal.gain, 2 * k);
  const double scale = fractal.renormalize ? 1.0 / std::sqrt(power) : 1.0;
  std::vector<WeightedOctave> octaves;
  for (int k = 0; k < fractal.octaves; ++k) {
    const double ratio = std::pow(fractal.lacunarity, k);
    const std::uint64_t seed =
        k == 0 ? recipe.seed : derive_seed(recipe.seed, kOctaveStream + static_cast<std::uint64_t>(k));
    octaves.push_back({make_surface_octave(recipe, frequency * ratio, bandwidth, seed), ratio,
                       scale * std::pow(fractal.gain, k)});
  }
  return octaves;
}

// A power of two of some wavelengths: single-precision offsets in it are exact to a millionth of one.
double cube_side(double frequency) {
  constexpr double kWavelengths = 16.0;
  return std::exp2(std::ceil(std::log2(kWavelengths / frequency)));
}

}  // namespace

std::vector<float> bake_noise(const SurfaceNoiseRecipe& recipe, const BakeVertices& vertices,
                              Progress* progress) {
  validate(recipe, vertices);
  const std::vector<WeightedOctave> octaves =
      make_octaves(recipe, vertices.frequency.constant, vertices.bandwidth.constant);
  const std::vector<VertexBatch> batches =
      make_batches(vertices.positions, cube_side(vertices.frequency.constant));

  std::vector<float> values(vertices.positions.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for_each(batches, [&](const VertexBatch& batch) {
    throw_if_cancelled(progress);
    GatheredBatch gathered(vertices, batch, has_direction(recipe));
    std::vector<float> sum(batch.vertices.size());
    std::vector<float> octave(batch.vertices.size());
    for (const WeightedOctave& weighted : octaves) {
      weighted.noise->evaluate(gathered.points(), gathered.parameters(weighted.ratio), octave);
      const auto amplitude = static_cast<float>(weighted.amplitude);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += amplitude * octave[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const std::uint32_t vertex = batch.vertices[i];
      const VertexNumber& magnitude = vertices.magnitude;
      values[vertex] =
          sum[i] * (magnitude.varies() ? magnitude.values[vertex] : static_cast<float>(magnitude.constant));
    }
    if (progress) progress->advance(done += batch.vertices.size(), values.size());
  });
  return values;
}

Noise<2>::Band surface_band(const SurfaceNoiseRecipe& recipe, double frequency, double bandwidth) {
  const std::vector<WeightedOctave> octaves = make_octaves(recipe, frequency, bandwidth);
  return {octaves.front().noise->band().lower, octaves.back().noise->band().upper};
}

}  // namespace solidnoise
