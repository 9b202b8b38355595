#pragma once

#include <string>

#include "solidnoise/core/vec.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of vectors as directions, in the world. A vector and its opposite are the same direction.
class DirectionField final : public PointwiseField {
 public:
  // Reads the grid and notes its digest in `source`; `flag` is what messages advise to give. Throws
  // std::runtime_error naming the file: it cannot be read, has no such grid of vectors, no active voxels, or
  // values that are not finite.
  DirectionField(GridFile& source, const std::string& flag);

  int channels() const override { return 3; }

  // Vectors of any length: the trilinear mean of the voxels around the position, with such signs that all
  // point to one side.
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override;

  const std::string& name() const { return name_; }  // "f.vdb: grid 'vel'"
  const openvdb::Vec3SGrid& grid() const { return *grid_; }

 private:
  openvdb::Vec3SGrid::ConstPtr grid_;
  std::string name_;
};

}  // namespace solidnoise
