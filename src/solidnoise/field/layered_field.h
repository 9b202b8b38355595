#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// Where a sample is in a box; see Layer::Place, which must not be none.
FieldPtr place_in(const Box<3>& box, UpAxis up, Layer::Place place);

// A noise that layers are made of, wherever they are evaluated: in a volume at the recipe's time and place,
// on a surface by its own parameters. All of unit variance.
struct LayerNoise {
  FractalOptions fractal;
  double frequency;  // of the first octave, cycles per world unit
  std::function<FieldPtr()> whole;
  std::function<FieldPtr(int k)> octave;      // octave k by itself
  std::function<FieldPtr(int axis)> channel;  // others like it, independent of each other and of it
  FieldPtr varying_frequency{};               // in place of `frequency`, where it differs from place to place
};

// How a layer, or a warp, uses a noise.
struct NoiseUse {
  const std::optional<NoiseRecipe>& noise;
  Vec<3> stretch{1.0};
  double turn = 0.0;
  double warp = 0.0;  // by how much warps move samples before it is looked up: the sum of their amounts
};

// How the leaves of a tree of layers are made.
struct LayerLeaves {
  std::function<LayerNoise(const NoiseUse&)> noise;
  std::function<FieldPtr(const std::string& name)> named{};
  std::function<FieldPtr(Layer::Place)> place{};
};

// Makes the field of a noise wherever it is evaluated.
using MakeNoise = std::function<FieldPtr(const NoiseRecipe&)>;
LayerNoise layer_noise(const NoiseRecipe& recipe, const MakeNoise& make_noise);

// The field of a tree of layers (the sum of those given; see Layer). A single layer that changes nothing is
// the noise itself, bit for bit. On a lattice noises are evaluated as lattices, but for layers that are
// warped, and at points. Throws std::invalid_argument if there are none.
FieldPtr make_layered_field(const std::vector<Layer>& layers, const LayerLeaves& leaves);

// Of noises alone, which are `own`, where a layer names none, or have seeds mixed with its own. Throws
// std::invalid_argument as validate_layers() does.
FieldPtr make_layered_field(const std::vector<Layer>& layers, const NoiseRecipe& own,
                            const MakeNoise& make_noise);

}  // namespace solidnoise
