#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/box.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field.h"
#include "solidnoise/volume/shaping.h"

namespace solidnoise {

// Maps values of a noise of unit variance to the range.
void to_range(RawShaping::Range range, std::span<float> values);

// A noise of unit variance in another range; RawShaping::Range::raw is the noise itself.
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RawShaping& shaping);

// A density from a noise of unit variance, see RemapShaping. The noise is clamped to 6 sigmas, so that what
// is certainly empty is known. `box` in world units is where `edge` is measured.
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RemapShaping& shaping,
                                  const Box<3>& box);

// A density from a noise of unit variance, see VeinShaping.
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const VeinShaping& shaping);

}  // namespace solidnoise
