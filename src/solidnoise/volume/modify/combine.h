#pragma once

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/modify/grid_lookup.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/topology/fill.h"

namespace solidnoise {

// Evaluates a field at the active voxels of a grid of any transform, or at their rest positions if there are
// any: what fill_grid does, for grids that no GridFrame describes. In parallel; the same to the last bit for
// any number of threads. The grid has no active tiles. Throws Cancelled, and as RestPositions does.
FilledGrid fill_grid_at_points(const openvdb::FloatGrid& grid, const Field<3>& field,
                               const RestPositions* rest, Progress* progress = nullptr);

// How values and noise become one, and where.
struct Combination {
  Combine combine = Combine::multiply;
  double amount = 0.5;
  const GridMask* mask = nullptr;  // everywhere, if there is none
};

// Combines the active values of a grid, which has no active tiles, with those of a noise of the same active
// voxels, in parallel; see Combine. A fog volume's values are kept from going under 0. Where the mask is 0
// values stay as they are, to the last bit. Throws std::invalid_argument if there is nothing to erode: the
// grid's largest value is not over 0.
void combine_values(openvdb::FloatGrid& grid, const openvdb::FloatGrid& noise,
                    const Combination& combination);

}  // namespace solidnoise
