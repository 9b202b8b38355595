#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What of a noise a grid holds.
enum class Output {
  value,      // the noise, or the density that its shaping makes of it; floats
  gradient,   // of the noise, per world unit; covariant vectors
  curl,       // a velocity without divergence; contravariant vectors (CurlField)
  color,      // three independent noises; vectors that no transform turns
  phase,      // of the phasor whose real part is the noise (Phasor), radians, -pi to pi; floats
  intensity,  // of the phasor: its absolute value, of unit mean square; floats
};

// The grid's name where the recipe gives none: density, gradient, vel, color, phase, intensity.
std::string_view default_grid_name(Output output);

int components_of(Output output);  // 1 or 3
std::vector<int> components_of(const std::vector<Output>& outputs);

// Sets what readers expect of an output's grid: how a transform turns its vectors, which are in world space.
// The class stays unknown: vectors are at the voxels' centres, not staggered.
void set_vector_type(openvdb::GridBase& grid, Output output);

// Outputs as flags and recipes have them: one or more words separated by commas, such as "value,gradient".
// Throws std::invalid_argument as validate_outputs does, and for a word that is none.
std::vector<Output> parse_outputs(std::string_view text);
std::string format_outputs(const std::vector<Output>& outputs);

// One output, or several that are made in one evaluation: value and gradient, phase and intensity. Throws
// std::invalid_argument.
void validate_outputs(const std::vector<Output>& outputs);

}  // namespace solidnoise
