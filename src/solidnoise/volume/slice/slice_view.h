#pragma once

#include <optional>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/slice/slice_field.h"

namespace solidnoise {

// Where a slice is looked at, as far as anybody says.
struct SliceView {
  std::optional<Vec<3>> origin;  // the middle; else 0, or the middle of the grid or the recipe's box
  std::optional<Vec<3>> normal;  // towards the viewer; else along z
  std::optional<Vec<3>> up;      // as far as the plane allows; else y, or, seen along y, -z
  std::optional<double> width;   // world units; else the noise's period, or 2, or that of the grid or box
};

// Puts the recipe's plane where the view says: of a noise with a period along the plane, one period of it;
// through the middle of what ends at the recipe's box, as large as that (is_bounded()).
// Throws std::invalid_argument as SlicePlane::face().
void place_plane(const SliceView& view, SliceRecipe& recipe);

// Puts the plane through the middle of bounds, and makes it as large as they are, a line as long, as far as
// the view leaves that open.
void fit_plane(const SliceView& view, const Box<3>& bounds, SlicePlane& plane);

}  // namespace solidnoise
