#pragma once

#include <string>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Throws std::invalid_argument if active values of a grid of floats or of vectors of them are not finite: how
// many, and where the first one is. `name` says in the message which grid it is. Grids of other types pass.
void require_finite_values(const openvdb::GridBase& grid, const std::string& name);

}  // namespace solidnoise
