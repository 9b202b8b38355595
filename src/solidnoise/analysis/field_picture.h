#pragma once

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/core/image.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

// Pictures of functions in the plane: axis 0 of a field goes to the right and axis 1 up, as x and y do.

// The middle square of a field, as wide as its shorter side, on `size` x `size` pixels: smoothed where it is
// enlarged, averaged where it is reduced. `lower` and `upper` are the values at the ramp's positions 0 and 1.
// sRGB-encoded.
Image field_picture(const DenseField<2>& field, int size, const ColorRamp& ramp, double lower, double upper);

// The magnitude |F(f)| of a field's Fourier transform (after a Hann window, if asked for, against the cross
// that the edges would make), frequency 0 in the middle. Values are logarithms,
//   log(1 + 200 |F| / max |F|) / log(201), 0 to 1,
// so that weak parts show. The step is that of the frequencies, in cycles per unit; the field is padded with
// zeros to `count` samples along each axis (0: not), which interpolates the transform.
enum class SpectrumWindow { none, hann };
DenseField<2> spectrum_magnitude(const DenseField<2>& field, SpectrumWindow window, int count = 0);

// The middle part of a field, `width` units wide and high at most (at least 2 samples).
DenseField<2> middle_part(const DenseField<2>& field, double width);

}  // namespace solidnoise
