#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// Domain warp: a layer is looked up at displaced positions,
//   p + amount (w0(p), w1(p), w2(p)),
// w three independent noises of unit variance. Where noise and layer have the same period, so has the result.
struct Warp {
  double amount = 0.1;                 // standard deviation of each component, world units; at least 0
  std::optional<NoiseRecipe> noise{};  // of which w are channels (channel_of()); none: that of the recipe

  friend bool operator==(const Warp&, const Warp&) = default;
};

// A node of the tree that a field is made of, plain data. Without layers of its own it is a noise, a named
// field or a place, otherwise what they combine to. Its value v becomes weight ramp(v) + bias.
//
// With n the noise of unit variance, n_k its octaves (each of unit variance) and g its gain, a noise becomes
//   none        n
//   billow      |n|
//   turbulence  sum of g^k |n_k|        (Perlin 1985)
//   ridged      sum of -g^k |n_k|       (Musgrave 1994 without his feedback from octave to octave)
//   crest       sum of g^k n_k / |z_k|, |z|^2 = n^2 + |grad n|^2 / (2 pi F)^2, over sqrt(sum of g^2k)
// less the mean, over the standard deviation, both of Gaussian octaves:
//   E |n| = sqrt(2 / pi),  Var |n| = 1 - 2 / pi,  times sum of g^k and of g^2k,
// so that a noise of these folds has mean 0 and variance 1 (the mean of |n| is k / 24 of it less where an
// octave has an excess kurtosis k). With Histogram::uniform it is instead mapped to 0..1 by its own
// distribution function, u = (1 + erf(n / sqrt 2)) / 2, erf(|n| / sqrt 2) and 1 - erf(|n| / sqrt 2), which
// exists in closed form for one octave, or unfolded, or billow.
//
// A crest is a wave without its envelope, from -1 to 1 (see crest_of()): each crest is as high as any other.
// With Histogram::uniform it becomes 1/2 + asin(n / |z|) / pi, which rises and falls evenly.
struct Layer {
  enum class Fold { none, ridged, billow, turbulence, crest };
  enum class Histogram { gaussian, uniform };
  enum class Combine {
    sum,
    product,
    max,
    min,
    mix,  // of three layers a, b, m: a + m (b - a), m clamped to 0..1
  };

  // Where a sample is in the recipe's box.
  enum class Place {
    none,
    x,
    y,
    z,       // 0 at the box's lower side, 1 at its upper one
    height,  // the same along the up axis
    radius,  // of the upright elliptic cylinder through it: 0 on the box's axis, 1 on the sides' middle lines
    distance,  // of the ellipsoid through it: 0 at the box's centre, 1 on the inscribed one
    weight,    // on a surface: of what steers, from 0 to 1
  };

  // Of a noise:
  std::optional<NoiseRecipe> noise{};  // none: that of the recipe; with a seed mixed with the recipe's
  Fold fold = Fold::none;
  Histogram histogram = Histogram::gaussian;
  Vec<3> stretch{1.0};  // how much longer its features are along each axis; > 0. Of the noise of a surface
                        // all three are the same
  double turn = 0.0;  // of the noise of a surface, if it is oriented: degrees by which its waves' directions
                      // turn in the tangent plane, against the clock as seen from outside; -360 to 360

  // Instead of a noise:
  std::string use{};          // a field that the recipe has a name for
  Place place = Place::none;  // where the sample is

  // Of several layers:
  std::vector<Layer> layers{};  // at most kMostLayers in the tree, kDeepestLayer levels of them
  Combine combine = Combine::sum;

  // Of both:
  std::vector<Vec<2>> ramp{};  // pairs of a value and what it becomes, values increasing; linear between
                               // them, constant beyond; none or at least 2
  double weight = 1.0;
  double bias = 0.0;
  std::optional<Warp> warp{};

  friend bool operator==(const Layer&, const Layer&) = default;
};

inline constexpr int kMostLayers = 64;
inline constexpr int kDeepestLayer = 8;

// Fields that have names, for layers to use; what is used by several is evaluated once.
using NamedLayers = std::map<std::string, Layer>;

// Where layers are. The noise of a surface has a plane to turn in, and a weight of what steers it.
enum class LayerSpace { volume, surface };

// What a recipe has that its layers may use.
struct LayerScope {
  const NoiseRecipe& own;  // its noise
  const NamedLayers& fields;
  LayerSpace space = LayerSpace::volume;
  std::string path_of_own = "noise";  // in the recipe
};

// Throws std::invalid_argument with the path in the recipe, such as "layers[1].noise.bandwidth is -1; ...",
// also where named fields use each other in a circle. `path` is that of the layers; those of named fields are
// at "fields.NAME".
void validate_layers(const std::vector<Layer>& layers, const LayerScope& scope,
                     const std::string& path = "layers");
void validate_layer(const Layer& layer, const LayerScope& scope, const std::string& path);

// Every noise of the tree, also those of warps and of the named fields that it uses, as it is made: with its
// seed mixed with that of `own`, which stands where a layer names none.
std::vector<NoiseRecipe> noises_of(const std::vector<Layer>& layers, const NoiseRecipe& own,
                                   const NamedLayers& named = {});

// Whether a layer or a warp has the recipe's noise.
bool use_own_noise(const std::vector<Layer>& layers, const NamedLayers& named = {});

// Whether a layer is a place of this kind.
bool use_place(const std::vector<Layer>& layers, Layer::Place place, const NamedLayers& named = {});

// The highest principal frequency of noises that layers have of their own, without octaves; 0 without any.
double finest_frequency(const std::vector<Layer>& layers, const NamedLayers& named = {});

// The largest amount of a warp, world units; 0 without any.
double largest_warp(const std::vector<Layer>& layers, const NamedLayers& named = {});

// The same layers, whose noises and warps are in units of `unit` world units: frequencies are divided by it,
// periods and amounts of warps multiplied.
std::vector<Layer> in_units(std::vector<Layer> layers, double unit);

// The noise that a layer or warp is made of.
NoiseRecipe noise_of_layer(const std::optional<NoiseRecipe>& noise, const NoiseRecipe& own);

}  // namespace solidnoise
