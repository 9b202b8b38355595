#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/shaping.h"

namespace solidnoise {

// One octave of a noise that is not summed: of unit variance, with the amplitude that it would be summed with
// relative to the first one.
struct Octave {
  FieldPtr noise;
  double amplitude = 1.0;
};

// What a cloud is made from.
struct CloudParts {
  CloudShaping shaping;
  std::vector<Octave> octaves;  // from low to high frequency; at least one
  double wavelength = 0.5;      // of the first octave, world units; > 0
  Box<3> box;                   // that the cloud stays in, world units
  UpAxis up = UpAxis::y;
  std::uint64_t seed = 0;  // of the pile of puffs
  // Of the lattices that the cloud is evaluated on, world units; their samples are of voxels, see
  // edge_cover(). Points have the edge as it is.
  Vec<3> voxel{0.0};
};

// See CloudShaping. Densities are 0 to 1. An octave is evaluated only in leaves where it can decide
// something: not deep inside of the cloud, nor farther outside than the lobes reach.
FieldPtr make_cloud_field(const CloudParts& parts);

}  // namespace solidnoise
