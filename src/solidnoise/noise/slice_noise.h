#pragma once

#include <memory>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A frame of a 4D noise, at time t, as a 3D noise. Its spectrum is that of the 4D noise integrated over the
// temporal frequency; it is not that of the 3D noise with the same parameters.
std::unique_ptr<Noise<3>> slice(std::shared_ptr<const Noise<4>> noise, double t);

}  // namespace solidnoise
