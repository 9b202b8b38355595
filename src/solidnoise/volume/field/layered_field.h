#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/field/layer.h"
#include "solidnoise/volume/field/point_field.h"

namespace solidnoise {

// What can be evaluated both on a lattice and at points.
class LayeredField : public Field, public PointField {};

// Makes a noise as it is in the volume: at its time and place.
using MakeNoise = std::function<std::shared_ptr<const Noise<3>>(const NoiseRecipe&)>;

// The field of a tree of layers (the sum of those given; see Layer). `own` is the noise of layers that name
// none. A single layer that changes nothing is the noise itself, bit for bit.
//
// On a lattice noises are evaluated as lattices, but for layers that are warped, and at points. Positions
// there are rounded to 2^-18 or less of the smallest wave of each noise, so that values depend on them only,
// not on the batch.
//
// Throws std::invalid_argument as validate_layers() does.
std::shared_ptr<const LayeredField> make_layered_field(const std::vector<Layer>& layers,
                                                       const NoiseRecipe& own, const MakeNoise& make_noise);

}  // namespace solidnoise
