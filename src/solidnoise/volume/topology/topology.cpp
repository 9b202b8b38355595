#include "solidnoise/volume/topology/topology.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;
constexpr int kLeafDim = static_cast<int>(MaskLeaf::DIM);
constexpr int kLeafLog2 = static_cast<int>(MaskLeaf::LOG2DIM);

// What a leaf of floats costs, with what accompanies it during a fill: its moments, its places in lists and
// its share of the tree's inner nodes, and malloc's own bytes for two allocations. Beside it there is the
// leaf of the mask. (A leaf of vectors costs less than one for each component.)
using FloatLeaf = openvdb::FloatTree::LeafNodeType;
constexpr std::uint64_t kBytesPerMaskLeaf = sizeof(MaskLeaf) + 16;
constexpr std::uint64_t kBytesPerLeaf =
    sizeof(FloatLeaf) + FloatLeaf::SIZE * sizeof(float) + sizeof(Moments) + 4 * sizeof(void*) +
    2 * sizeof(openvdb::FloatTree::RootNodeType::ChildNodeType::ChildNodeType) /
        openvdb::FloatTree::RootNodeType::ChildNodeType::ChildNodeType::NUM_VALUES +
    2 * 16;

// Makes the leaves that touch `voxels`; `shape` switches on the voxels of an empty leaf. Leaves are made slab
// by slab in parallel and added to the tree in order.
template <typename Shape>
openvdb::MaskTree::Ptr make_mask(const openvdb::CoordBBox& voxels, const Shape& shape) {
  auto tree = std::make_shared<openvdb::MaskTree>(false);
  const openvdb::Coord first = voxels.min() & ~(kLeafDim - 1);
  const int slabs = ((voxels.max().x() - first.x()) >> kLeafLog2) + 1;
  std::vector<std::vector<std::unique_ptr<MaskLeaf>>> leaves(static_cast<std::size_t>(slabs));
  tbb::parallel_for(0, slabs, [&](int slab) {
    openvdb::Coord origin;
    origin.x() = first.x() + slab * kLeafDim;
    for (origin.y() = first.y(); origin.y() <= voxels.max().y(); origin.y() += kLeafDim) {
      for (origin.z() = first.z(); origin.z() <= voxels.max().z(); origin.z() += kLeafDim) {
        auto leaf = std::make_unique<MaskLeaf>(openvdb::PartialCreate(), origin, false, false);
        shape(*leaf);
        if (!leaf->isEmpty()) leaves[static_cast<std::size_t>(slab)].push_back(std::move(leaf));
      }
    }
  });
  for (auto& slab : leaves) {
    for (auto& leaf : slab) tree->addLeaf(leaf.release());
  }
  return tree;
}

[[noreturn]] void refuse_empty(const char* shape) {
  throw std::invalid_argument(std::string(shape) +
                              " holds no voxel's centre: make it larger, or the voxels smaller");
}

Topology require_voxels(Topology topology, const char* shape) {
  if (topology.mask->empty()) refuse_empty(shape);
  return topology;
}

// Grids whose active voxels can be taken over.
using MaskableGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
                                        openvdb::Int64Grid, openvdb::BoolGrid, openvdb::MaskGrid,
                                        openvdb::Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>;

// Leaves are in lists while a mask is made.
constexpr std::uint64_t kBytesOfLists = 3 * sizeof(void*);

std::uint64_t bytes_for(double leaves, std::uint64_t bytes_per_leaf) {
  constexpr double kLargest = 0x1.0p63;
  return static_cast<std::uint64_t>(std::min(leaves * static_cast<double>(bytes_per_leaf), kLargest));
}

std::uint64_t bytes_of_leaf(int channels) {
  return kBytesPerMaskLeaf + static_cast<std::uint64_t>(channels) * kBytesPerLeaf;
}

// Of all that touch the box.
double count_leaves(const openvdb::CoordBBox& voxels) {
  if (voxels.empty()) return 0.0;
  double leaves = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t first = voxels.min()[axis] >> kLeafLog2;
    const std::int64_t last = voxels.max()[axis] >> kLeafLog2;
    leaves *= static_cast<double>(last - first + 1);
  }
  return leaves;
}

// With those that active tiles would be.
double count_leaves(const openvdb::GridBase& grid) {
  const openvdb::TreeBase& tree = grid.baseTree();
  const std::uint64_t in_tiles = tree.activeVoxelCount() - tree.activeLeafVoxelCount();
  return static_cast<double>(tree.leafCount()) +
         static_cast<double>(in_tiles) / static_cast<double>(MaskLeaf::SIZE);
}

}  // namespace

std::uint64_t Topology::leaf_count() const {
  return mask->leafCount();
}

std::uint64_t Topology::voxel_count() const {
  return mask->activeVoxelCount();
}

openvdb::CoordBBox Topology::voxel_bounds() const {
  openvdb::CoordBBox bounds;
  mask->evalActiveVoxelBoundingBox(bounds);
  return bounds;
}

Topology box_topology(const GridFrame& frame, const Box<3>& box) {
  const openvdb::CoordBBox voxels = frame.voxels_in(box);
  if (voxels.empty()) refuse_empty("the box");
  const auto shape = [&](MaskLeaf& leaf) {
    openvdb::CoordBBox part = leaf.getNodeBoundingBox();
    if (voxels.isInside(part)) {
      leaf.setValuesOn();
      return;
    }
    part.intersect(voxels);
    for (auto voxel = part.begin(); voxel; ++voxel) leaf.setValueOn(*voxel);
  };
  return {frame, make_mask(voxels, shape)};
}

Topology ellipsoid_topology(const GridFrame& frame, const Vec<3>& centre, const Vec<3>& radii) {
  for (int axis = 0; axis < 3; ++axis) {
    require_finite("the ellipsoid's centre", centre[axis]);
    require_positive("the ellipsoid's radius", radii[axis], "world units");
  }
  openvdb::CoordBBox voxels = frame.voxels_in({centre - radii, centre + radii});
  if (voxels.empty()) refuse_empty("the ellipsoid");
  voxels.expand(1);  // voxels_in leaves out the upper border

  // Squared distance from the centre along one axis, where the radius is 1.
  const auto square = [&](int axis, std::int32_t index) {
    const double d = (frame.origin()[axis] + frame.voxel_size()[axis] * index - centre[axis]) / radii[axis];
    return d * d;
  };
  const auto shape = [&](MaskLeaf& leaf) {
    double squares[3][kLeafDim];
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kLeafDim; ++i) squares[axis][i] = square(axis, leaf.origin()[axis] + i);
    }
    for (unsigned voxel = 0; voxel < MaskLeaf::SIZE; ++voxel) {
      const openvdb::Coord i = MaskLeaf::offsetToLocalCoord(voxel);
      if (squares[0][i.x()] + squares[1][i.y()] + squares[2][i.z()] <= 1.0) leaf.setValueOn(voxel);
    }
  };
  return require_voxels({frame, make_mask(voxels, shape)}, "the ellipsoid");
}

Topology sphere_topology(const GridFrame& frame, const Vec<3>& centre, double radius) {
  return ellipsoid_topology(frame, centre, Vec<3>(radius));
}

Topology grid_topology(const openvdb::GridBase& grid) {
  openvdb::MaskTree::Ptr mask;
  const bool known = grid.apply<MaskableGrids>([&](const auto& typed) {
    mask = std::make_shared<openvdb::MaskTree>(typed.tree(), false, true, openvdb::TopologyCopy());
  });
  if (!known) {
    throw std::invalid_argument("the voxels of a grid of type " + grid.valueType() + " cannot be used");
  }
  mask->voxelizeActiveTiles();
  openvdb::tools::pruneInactive(*mask);
  if (mask->empty()) throw std::invalid_argument("the grid has no active voxels");
  return {GridFrame(grid.transform()), mask};
}

std::uint64_t estimate_memory(const openvdb::CoordBBox& voxels, int channels) {
  return bytes_for(count_leaves(voxels), bytes_of_leaf(channels));
}

std::uint64_t estimate_memory(const Topology& topology, int channels) {
  return bytes_for(static_cast<double>(topology.leaf_count()), bytes_of_leaf(channels));
}

namespace {

// Of a tree's nodes above its leaves, which are many where voxels are far apart, but for the first of each
// kind.
std::uint64_t node_bytes(const openvdb::GridBase& grid) {
  using Lower = openvdb::MaskTree::RootNodeType::ChildNodeType::ChildNodeType;
  using Upper = openvdb::MaskTree::RootNodeType::ChildNodeType;
  const std::vector<openvdb::Index32> counts = grid.constBaseTree().nodeCount();  // from the leaves up
  if (counts.size() < 3 || counts[1] == 0 || counts[2] == 0) return 0;
  return (counts[1] - 1) * sizeof(Lower) + (counts[2] - 1) * sizeof(Upper);
}

}  // namespace

std::uint64_t estimate_memory(const openvdb::GridBase& grid, int channels) {
  return bytes_for(count_leaves(grid), bytes_of_leaf(channels)) + 2 * node_bytes(grid);
}

std::uint64_t estimate_mask_memory(const openvdb::CoordBBox& voxels) {
  return bytes_for(count_leaves(voxels), kBytesPerMaskLeaf + kBytesOfLists);
}

std::uint64_t estimate_mask_memory(const openvdb::GridBase& grid) {
  return bytes_for(count_leaves(grid), kBytesPerMaskLeaf + kBytesOfLists) + node_bytes(grid);
}

}  // namespace solidnoise
