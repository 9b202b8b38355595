#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "solidnoise/volume/statistics.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What becomes of voxels where the field is 0, the background.
enum class Sparsity {
  keep,  // the grid's active voxels are the topology's
  drop,  // voxels that are exactly 0 are inactive, and leaves of nothing else are not kept
};

// A grid of floats or of vectors (Vec3SGrid).
struct MeasuredGrid {
  openvdb::GridBase::Ptr grid;
  std::vector<Moments> moments;  // of the active voxels, of each component
};

// Where the values of one grid go during a fill, leaf by leaf. Leaves may be stored in any order and by any
// thread, each index once.
class GridSink {
 public:
  using MaskLeaf = openvdb::MaskTree::LeafNodeType;

  virtual ~GridSink() = default;

  virtual std::size_t components() const = 0;
  virtual void store_zeros(std::size_t index, const MaskLeaf& mask) = 0;
  // `values` has a leaf's values of one component after the other.
  virtual void store(std::size_t index, const MaskLeaf& mask, std::span<const float> values) = 0;
  // The grid of what was stored, its leaves in the order of their indices; once.
  virtual MeasuredGrid collect(const GridFrame& frame) = 0;
};

// For a grid of 1 component (floats) or 3 (vectors), of up to `leaves` leaves. Throws std::invalid_argument
// for another number of components.
std::unique_ptr<GridSink> make_grid_sink(int components, std::size_t leaves, Sparsity sparsity);

}  // namespace solidnoise
