#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/box.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/field/shaping.h"

namespace solidnoise {

// Maps values of a noise of unit variance to the range.
void to_range(RawShaping::Range range, std::span<float> values);

// A field in another range, as a noise of unit variance is; RawShaping::Range::raw is the field itself.
std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const RawShaping& shaping);

// A density from a field in the place of a noise of unit variance, see RemapShaping. It is clamped to +-6, so
// that what is certainly empty is known. `box` in world units is where `edge` is measured.
std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const RemapShaping& shaping,
                                  const Box<3>& box);

// A density from a field in the place of a noise of unit variance, see VeinShaping.
std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const VeinShaping& shaping);

// The same of a noise of unit variance.
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RawShaping& shaping);
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RemapShaping& shaping,
                                  const Box<3>& box);
std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const VeinShaping& shaping);

}  // namespace solidnoise
