#pragma once

#include <cstdint>
#include <optional>

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {

// What a modification reads, checked; nothing of it changes.
struct ModificationPlan {
  Modification modification;  // with the digests of its files
  VdbFile file;               // all that the grid's file holds
  std::size_t target = 0;     // the grid's place in it
  openvdb::GridBase::Ptr mask;
  openvdb::GridBase::Ptr rest;

  const openvdb::FloatGrid& grid() const;

  // Whether noise is needed on a lattice. Otherwise it is at points: on a surface, at rest positions, or at
  // the voxels of a grid of no GridFrame.
  bool on_lattice() const;
  std::optional<GridFrame> frame() const;  // of the grid, where its transform is axis-aligned

  // Voxels that are made, about: of a displaced surface more than the grid has, where noise of `frequency`
  // (cycles per world unit) and root mean square `sigma` moves it.
  double voxels(double frequency, double sigma) const;
  // Bytes that all of it takes at most then, files included.
  std::uint64_t memory(double frequency, double sigma) const;
};

// Reads the files. Throws std::runtime_error naming the file: also for a grid that does not exist (those that
// do are listed), one of a type or class that cannot be used so, values that are not finite, a mask that lies
// elsewhere; std::invalid_argument for options.
ModificationPlan plan_modification(const Modification& modification, Progress* progress = nullptr);

// Noise at the grid's active voxels, as it is combined with their values.
FilledGrid make_modifying_noise(const ModificationPlan& plan, const Field<3>& field, Progress* progress);

// The grid with the noise in it, by the mask; the plan's own stays as it is. Throws std::runtime_error naming
// the file, Cancelled.
openvdb::FloatGrid::Ptr combine(const ModificationPlan& plan, const openvdb::FloatGrid& noise);
openvdb::FloatGrid::Ptr displace(const ModificationPlan& plan, FieldPtr noise, Progress* progress);

// The file's grids with `changed` in the target's place.
openvdb::GridPtrVec replace_target(const ModificationPlan& plan, openvdb::FloatGrid::Ptr changed);

}  // namespace solidnoise
