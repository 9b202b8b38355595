#pragma once

#include <array>
#include <memory>

#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A topology of voxels without those for which a test fails. `make_test()` makes a test, called with
// coordinates, for each leaf. In parallel. Throws Cancelled.
template <typename MakeTest>
openvdb::MaskTree::Ptr select_voxels(const openvdb::MaskTree& from, Progress* progress,
                                     const MakeTest& make_test) {
  auto result = std::make_shared<openvdb::MaskTree>(from);
  openvdb::tree::LeafManager<openvdb::MaskTree> leaves(*result);
  leaves.foreach ([&](openvdb::MaskTree::LeafNodeType& leaf, std::size_t) {
    throw_if_cancelled(progress);
    const auto test = make_test();
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
      if (!test(voxel.getCoord())) leaf.setValueOff(voxel.pos());
    }
  });
  openvdb::tools::pruneInactive(*result);
  return result;
}

// The six neighbours of a voxel that share a face with it.
inline std::array<openvdb::Coord, 6> face_neighbours(const openvdb::Coord& voxel) {
  return {voxel.offsetBy(-1, 0, 0), voxel.offsetBy(1, 0, 0),  voxel.offsetBy(0, -1, 0),
          voxel.offsetBy(0, 1, 0),  voxel.offsetBy(0, 0, -1), voxel.offsetBy(0, 0, 1)};
}

// Those active voxels of a grid that have an active face neighbour on the other side of its zeros.
inline openvdb::MaskTree::Ptr voxels_beside_zeros(const openvdb::FloatGrid& grid, Progress* progress) {
  const openvdb::MaskTree all(grid.tree(), false, true, openvdb::TopologyCopy());
  return select_voxels(all, progress, [&] {
    return [values = grid.getConstAccessor()](const openvdb::Coord& voxel) {
      const bool inside = values.getValue(voxel) < 0.0f;
      for (const openvdb::Coord& other : face_neighbours(voxel)) {
        float value = 0.0f;
        if (values.probeValue(other, value) && (value < 0.0f) != inside) return true;
      }
      return false;
    };
  });
}

}  // namespace solidnoise
