#pragma once

#include <memory>
#include <vector>

#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/field/shaping.h"
#include "solidnoise/volume/output.h"

namespace solidnoise {

// Fields of several channels, in the order of `outputs`.

// Output::value and Output::gradient of a noise, or one of them: one evaluation makes both. The derivatives
// are the noise's analytic ones, per world unit.
std::unique_ptr<Field> make_gradient_field(std::shared_ptr<const Noise<3>> noise,
                                           const std::vector<Output>& outputs);

// Output::phase and Output::intensity, or one of them, of the phasor z = real + i imaginary of two noises of
// unit variance (make_quadrature):
//   phase = arg z, radians, -pi to pi;   intensity = |z| / sqrt 2, of unit mean square;
// so that the noise `real` is sqrt 2 intensity cos(phase). Where the noise is near Gaussian the intensity has
// a Rayleigh distribution, of mean sqrt(pi) / 2. The phase jumps by 2 pi where it passes pi, and has no value
// on the lines where the intensity is 0. (Tricard et al. 2019.)
std::unique_ptr<Field> make_phasor_field(std::shared_ptr<const Noise<3>> real,
                                         std::shared_ptr<const Noise<3>> imaginary,
                                         const std::vector<Output>& outputs);

// Independent noises, such as three colours: each in a channel, in a range of RawShaping.
std::unique_ptr<Field> make_channels_field(const std::vector<std::shared_ptr<const Noise<3>>>& noises,
                                           const RawShaping& range);

// The colours of an exemplar: noises of unit variance, one for each channel of its model, put together as
// ExemplarModel::color says. In the exemplar's own values: linear light, unless the model's are raw.
std::unique_ptr<Field> make_exemplar_colors(std::vector<std::shared_ptr<const Noise<3>>> noises,
                                            const ExemplarModel& model);

}  // namespace solidnoise
