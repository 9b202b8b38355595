#pragma once

#include <memory>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise moved by `offset`, world units: its value at x is that of `noise` at x - offset. Statistics and
// spectrum are the noise's. Throws std::invalid_argument for an offset that is not finite.
template <int Dim>
std::unique_ptr<Noise<Dim>> move_noise(std::shared_ptr<const Noise<Dim>> noise, const Vec<Dim>& offset);

}  // namespace solidnoise
