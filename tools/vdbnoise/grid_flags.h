#pragma once

#include <optional>
#include <string>

#include "common/flag_set.h"
#include "solidnoise/volume/vdb/grid_file.h"

namespace solidnoise {

// The value of a flag that names a grid, "FILE.vdb" or "FILE.vdb:GRID"; the file with its whole path, so that
// a recipe can be used from any folder. Throws UsageError.
GridFile parse_grid_flag(const std::string& flag, const std::string& text);

// Declares such a flag; what it names is kept in `target`.
void declare_grid_file(FlagSet& flags, const std::string& flag, const std::string& help,
                       std::optional<GridFile>& target);

}  // namespace solidnoise
