#pragma once

#include <span>
#include <string>
#include <utility>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "vdbnoise/slice_field.h"
#include "vdbnoise/slice_options.h"

namespace solidnoise {

// The source's values at the centres of the plane's pixels, in parallel; axis 0 goes to the right, axis 1 up.
// They are the same to the last bit for any number of threads. Throws Cancelled.
DenseField<2> sample_slice(const SliceSource& source, const SlicePlane& plane, Progress* progress);

// The values that are black and white in a picture of the slice.
std::pair<double, double> shown_values(const SliceOptions& options, const SliceField& field,
                                       const DenseField<2>& slice);

// What --out is a picture of, as it is stored: the values themselves in an .exr without a ramp, one channel;
// colours, linear in an .exr and sRGB-encoded elsewhere; or grey, one channel.
Image slice_image(const SliceOptions& options, const DenseField<2>& slice, double low, double high);

// The same of --color: the colours of an exemplar, as they are stored (linear in an .exr, unless the
// exemplar's values are raw), or each channel grey.
Image color_image(const SliceOptions& options, std::span<const DenseField<2>> channels, double low,
                  double high);

// What --spectrum is a picture of: the periodogram, with a Hann window unless the slice wraps.
Image spectrum_image(const SliceOptions& options, const DenseField<2>& slice);

// What --out FILE.csv holds: a line "position,value" of names, and one for each sample. The position is the
// coordinate along the plane's direction to the right.
std::string line_table(const SlicePlane& plane, const DenseField<2>& slice);

}  // namespace solidnoise
