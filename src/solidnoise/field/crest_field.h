#pragma once

#include "solidnoise/core/field.h"

namespace solidnoise {

// The waves of a noise without their envelope: of a noise n of principal frequency F,
//   n / |z|,   |z|^2 = n^2 + |grad n|^2 / (2 pi F)^2,
// from -1 to 1. Where the gradient is 0 it is 1 or -1, so that all crests are equally high and all troughs
// equally deep; it is 0 where n is. Of oriented noise it is the cosine of the phase of a phasor noise
// (Tricard et al. 2019): the derivative along the waves is 2 pi F times the noise that is a quarter of a wave
// behind, up to the band's width over F. We take the gradient, not that noise, because the noise of isotropic
// kernels has one too (the amplitude of Felsberg and Sommer's monogenic signal 2001, with the gradient for
// the Riesz transform), and because where waves end or fork z is not 0 but turns across them: there is no
// jump.
//
// `frequency` in cycles per world unit; `varying`, where it is not null, takes its place. Without a gradient
// of its own. Throws std::invalid_argument if the field has no gradient or several channels.
FieldPtr crest_of(FieldPtr field, double frequency, FieldPtr varying = nullptr);

}  // namespace solidnoise
