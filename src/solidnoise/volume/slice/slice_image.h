#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise {

// The source's values at the centres of the plane's pixels, each channel's, in parallel; axis 0 goes to the
// right, axis 1 up. They are the same to the last bit for any number of threads. Throws Cancelled.
std::vector<DenseField<2>> sample_slice(const SliceSource& source, const SlicePlane& plane,
                                        Progress* progress);

// The values that are black and white in a picture of the slice, of one channel or of several.
std::pair<double, double> shown_values(const SliceRecipe& recipe, const SliceField& field,
                                       std::span<const DenseField<2>> channels);

// What the pixels of a picture are: 0 to 1 for the eye, colours sRGB-encoded; or for floats, the values
// themselves, colours in linear light.
enum class PixelForm { shown, values };

// A picture of the slice, in grey (one channel) or by the ramp.
Image slice_image(const SliceRecipe& recipe, const DenseField<2>& slice, std::pair<double, double> shown,
                  PixelForm form);

// The same of three channels: the colours of an exemplar (as they are stored, where the exemplar's values are
// raw), or each channel grey.
Image color_image(const SliceField& field, std::span<const DenseField<2>> channels,
                  std::pair<double, double> shown, PixelForm form);

// The slice's periodogram, with a Hann window unless the slice wraps.
Image spectrum_image(const SliceRecipe& recipe, const DenseField<2>& slice, PixelForm form);

// A line "position,value" of names, and one for each sample of the first row. The position is the
// coordinate along the plane's direction to the right.
std::string line_table(const SlicePlane& plane, const DenseField<2>& slice);

}  // namespace solidnoise
