#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "solidnoise/core/vec.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/varying_field.h"
#include "solidnoise/volume/parameters/parameter_grids.h"
#include "solidnoise/volume/parameters/scalar_field.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of vectors as directions, in the world. A vector and its opposite are the same direction.
class DirectionField final : public PointwiseField {
 public:
  // Reads the grid and notes its digest in `source`; `flag` is what messages advise to give. Throws
  // std::runtime_error naming the file: it cannot be read, has no such grid of vectors, no active voxels, or
  // values that are not finite.
  DirectionField(GridFile& source, const std::string& flag, Progress* progress = nullptr);

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

// The grids of a recipe's parameters, read. Immutable; may be shared between threads.
class ParameterFields {
 public:
  // Throws std::runtime_error as the fields do.
  explicit ParameterFields(const ParameterGrids& grids, Progress* progress = nullptr);

  const ParameterGrids& grids() const { return grids_; }  // with the digests of their files
  std::uint64_t memory() const;                           // bytes

  KernelFields kernel() const;
  // The standard deviation, in sigmas of the noise; null: 1 everywhere.
  const std::shared_ptr<const ScalarField>& magnitude() const { return magnitude_; }

  // Throws std::runtime_error naming the file if a grid has nothing in the box, world units.
  void require_overlap(const Box<3>& box) const;

  // Throws std::runtime_error if a parameter is not allowed at some of the voxels: see ScalarField.
  void require_allowed_at(const Topology& topology) const;

 private:
  ParameterGrids grids_;
  std::shared_ptr<const ScalarField> frequency_;
  std::shared_ptr<const ScalarField> bandwidth_;
  std::shared_ptr<const ScalarField> magnitude_;
  std::shared_ptr<const DirectionField> direction_;
};

}  // namespace solidnoise
