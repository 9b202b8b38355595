#pragma once

#include <cstddef>
#include <string>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A file of grids that is open for reading. Each function throws std::exception of any kind where the file is
// damaged.
class GridSource {
 public:
  virtual ~GridSource() = default;

  virtual const openvdb::MetaMap& metadata() const = 0;

  // In the file's order.
  virtual std::size_t grid_count() const = 0;
  virtual std::string grid_name(std::size_t index) const = 0;

  // The grid with its name, type, metadata and transform; its tree may be empty.
  virtual openvdb::GridBase::Ptr read_header(std::size_t index) = 0;
  // All of the grid.
  virtual openvdb::GridBase::Ptr read_grid(std::size_t index) = 0;
  // All of all grids. Those that share a tree in the file share it here.
  virtual openvdb::GridPtrVec read_grids() = 0;
};

}  // namespace solidnoise
