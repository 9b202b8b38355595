#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "solidnoise/mesh/bake_noise.h"

namespace solidnoise {

// What a parameter follows over a mesh.
enum class SteeringSource {
  mean_curvature,      // (k1 + k2) / 2: negative in creases, positive on ridges
  gaussian_curvature,  // k1 k2: negative on saddles
  max_curvature,       // k1 or k2, the one of larger magnitude
  abs_curvature,  // curvedness sqrt((k1^2 + k2^2) / 2) (Koenderink and van Doorn 1992): how much, whichever
                  // way
  height,         // along the up axis
  attribute,      // a number that the mesh's vertices have
};

// How numbers become weights from 0 to 1.
struct Steering {
  SteeringSource source = SteeringSource::mean_curvature;
  std::string attribute = {};     // its name, where the source is one
  double low_percentile = 5.0;    // of the surface: what gets weight 0, and below it;
  double high_percentile = 95.0;  // weight 1, and above it; 0 <= low < high <= 100
  double gamma = 1.0;             // exponent of the weights; > 0

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const Steering&, const Steering&) = default;
};

// Weights of numbers, one each, and what they were made of.
struct SteeringWeights {
  static constexpr std::size_t kBins = 40;

  std::vector<float> weights;  // 0 to 1
  double low = 0.0;            // the number of weight 0
  double high = 0.0;           // the number of weight 1
  double least = 0.0;          // of all numbers that count
  double most = 0.0;
  // How many numbers there are, whatever their areas, from low to high; the ends hold those beyond.
  std::array<std::size_t, kBins> histogram{};
};

// weight = clamp((number - low) / (high - low))^gamma, low and high being the numbers at the percentiles,
// which keep a few extreme vertices from taking the whole range. Each number counts by its area: percentiles
// of the vertices would follow the density of the mesh, and change with it. Without areas, or if none is
// positive, all count alike. Where all numbers between the percentiles are the same, all weights are 1/2.
// Numbers that are not finite get weight 1/2 and do not count. Throws std::invalid_argument:
// steering.validate(), another number of areas than of numbers.
SteeringWeights make_weights(std::span<const double> numbers, const Steering& steering,
                             std::span<const double> areas = {});

// The values of a parameter at weights 0 and 1. They may decrease.
struct ParameterRange {
  double from = 1.0;
  double to = 1.0;

  bool varies() const { return from != to; }

  friend bool operator==(const ParameterRange&, const ParameterRange&) = default;
};

// Between the ends: linear in the parameter, or in its logarithm, as suits frequencies.
enum class Interpolation { linear, logarithmic };

// The parameter at weights. One constant number if the range has only one.
VertexNumber steer(const ParameterRange& range, Interpolation interpolation, std::span<const float> weights);

// The histogram as lines of text, `width` characters of bars at most.
std::string draw_histogram(const SteeringWeights& weights, std::size_t width);

}  // namespace solidnoise
