#include "solidnoise/core/cell_grid.h"

#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {

void CellAxis::refuse(double coordinate) const {
  throw std::invalid_argument(fmt::format(
      "a position has a coordinate of {}; with the noise's frequency it must be within {:.6g}, 2^40 cells",
      coordinate, kMostCells * size_));
}

}  // namespace solidnoise
