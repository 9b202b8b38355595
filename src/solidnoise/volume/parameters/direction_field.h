#pragma once

#include <array>
#include <span>
#include <string>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of vectors as directions, in the world. A vector and its opposite are the same direction.
class DirectionField {
 public:
  // Reads the grid and notes its digest in `source`; `flag` is what messages advise to give. Throws
  // std::runtime_error naming the file: it cannot be read, has no such grid of vectors, no active voxels, or
  // values that are not finite.
  DirectionField(GridFile& source, const std::string& flag);

  // Overwrites `values`, one vector of any length per position (world units), component by component: the
  // trilinear mean of the voxels around it, with such signs that all point to one side.
  void sample(std::span<const Vec<3>> positions, const std::array<std::span<float>, 3>& values) const;

  const std::string& name() const { return name_; }  // "f.vdb: grid 'vel'"
  const openvdb::Vec3SGrid& grid() const { return *grid_; }

 private:
  openvdb::Vec3SGrid::ConstPtr grid_;
  std::string name_;
};

}  // namespace solidnoise
