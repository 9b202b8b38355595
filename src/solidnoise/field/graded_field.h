#pragma once

#include <functional>

#include "solidnoise/core/field.h"
#include "solidnoise/field/varying_field.h"

namespace solidnoise {

// How many frequencies of graded noises there are to an octave.
inline constexpr int kGradesPerOctave = 2;

// The noise of grade k, of unit variance and of the frequency 2^(k / kGradesPerOctave) cycles per unit;
// of other grades it is independent.
using GradedNoise = std::function<FieldPtr(double frequency, int grade)>;  // in cycles per world unit

// A noise whose kernels cannot vary, at a frequency that does: at each point the two noises whose frequencies
// are next to the one there, blended by weights of unit square sum. Being independent they keep the variance
// of one, 1 everywhere, and the spectrum is the blend of theirs: a quarter octave off at most. Where the
// frequency is that of a grade it is that noise alone. For noises of Gabor kernels see make_varying_field(),
// which has every frequency.
//
// `unit`: world units; the noise of what is as much larger, at frequencies as much lower, is the same.
//
// The gradient holds the frequency at the point fixed. A value depends on the point and the frequency there
// only, since grades are those of all frequencies there are, not of some range. Throws what `noise` throws.
FieldPtr make_graded_field(const VaryingParameter& frequency, double unit, const GradedNoise& noise);

}  // namespace solidnoise
