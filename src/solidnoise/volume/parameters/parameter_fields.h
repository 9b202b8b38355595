#pragma once

#include <cstdint>
#include <optional>

#include "solidnoise/core/box.h"
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

  const std::optional<ScalarField>& frequency() const { return frequency_; }
  const std::optional<ScalarField>& bandwidth() const { return bandwidth_; }
  const std::optional<ScalarField>& magnitude() const { return magnitude_; }
  const std::optional<DirectionField>& direction() const { return direction_; }

  // Throws std::runtime_error naming the file if a grid has nothing in the box, world units.
  void require_overlap(const Box<3>& box) const;

  // Throws std::runtime_error if a parameter is not allowed at some of the voxels: see ScalarField.
  void require_allowed_at(const Topology& topology) const;

 private:
  ParameterGrids grids_;
  std::optional<ScalarField> frequency_;
  std::optional<ScalarField> bandwidth_;
  std::optional<ScalarField> magnitude_;
  std::optional<DirectionField> direction_;
};

}  // namespace solidnoise
