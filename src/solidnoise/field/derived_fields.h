#pragma once

#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// The gradient of a field of one channel, per world unit: three channels. Throws std::invalid_argument if it
// has none.
FieldPtr gradient_of(FieldPtr field);

// The value, and the three components of the gradient: one evaluation makes all four.
FieldPtr value_and_gradient_of(FieldPtr field);

// Phase and intensity of the phasor z = real + i imaginary of two noises of unit variance (make_quadrature):
//   phase = arg z, radians, -pi to pi;   intensity = |z| / sqrt 2, of unit mean square;
// so that the noise `real` is sqrt 2 intensity cos(phase). Where the noise is near Gaussian the intensity has
// a Rayleigh distribution, of mean sqrt(pi) / 2. The phase jumps by 2 pi where it passes pi, and has no value
// on the lines where the intensity is 0. (Tricard et al. 2019.)
FieldPtr phasor_of(FieldPtr real, FieldPtr imaginary);

// The colours of an exemplar: three channels of noises of unit variance, one for each channel of its model,
// put together as ChannelColors says. In the exemplar's own values: linear light, unless the model's are raw.
FieldPtr exemplar_colors_of(std::vector<FieldPtr> noises, const ExemplarModel& model);

}  // namespace solidnoise
