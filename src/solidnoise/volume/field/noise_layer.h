#pragma once

#include <memory>

#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field/layered_field.h"

namespace solidnoise {

// A noise by itself. `highest_frequency`, in cycles per world unit, is that of its last octave: positions are
// rounded to a power of two at most 2^-18 of its wavelength.
std::shared_ptr<const LayeredField> make_noise_layer(std::shared_ptr<const Noise<3>> noise,
                                                     double highest_frequency);

}  // namespace solidnoise
