#pragma once

#include <cstdint>
#include <memory>

#include "solidnoise/core/box.h"
#include "solidnoise/field/varying_field.h"
#include "solidnoise/volume/parameters/direction_field.h"
#include "solidnoise/volume/parameters/parameter_grids.h"
#include "solidnoise/volume/parameters/scalar_field.h"
#include "solidnoise/volume/topology/topology.h"

namespace solidnoise {

// The grids of a recipe's parameters, read. Immutable; may be shared between threads.
class ParameterFields {
 public:
  // Throws std::runtime_error as the fields do.
  explicit ParameterFields(const ParameterGrids& grids);

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
