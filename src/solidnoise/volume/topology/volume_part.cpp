#include "solidnoise/volume/topology/volume_part.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

constexpr int kMostShards = 65536;
constexpr int kBlockLog2 = 5;  // 32^3 voxels

bool in_region(const GridFrame& frame, const Box<3>& region, const openvdb::Coord& voxel) {
  const Vec<3> centre = frame.bounds({voxel, voxel}).lower;
  for (int axis = 0; axis < 3; ++axis) {
    if (centre[axis] < region.lower[axis] || centre[axis] >= region.upper[axis]) return false;
  }
  return true;
}

}  // namespace

void VolumePart::validate() const {
  require_in_range("shards", shards, 1, kMostShards);
  require_in_range("shard", shard, 1, shards);
  if (!region) return;
  for (int axis = 0; axis < 3; ++axis) {
    require_finite("region", region->lower[axis]);
    require_finite("region", region->upper[axis]);
    if (region->lower[axis] >= region->upper[axis]) {
      throw std::invalid_argument(
          fmt::format("region reaches from {} to {} on axis {}; the second corner must be above the first",
                      region->lower[axis], region->upper[axis], "xyz"[axis]));
    }
  }
}

std::string text_of(const VolumePart& part) {
  std::string text = fmt::format("{}/{}", part.shard, part.shards);
  if (part.region) {
    const Vec<3>& a = part.region->lower;
    const Vec<3>& b = part.region->upper;
    text += fmt::format(" of {} {} {} {} {} {}", a.x, a.y, a.z, b.x, b.y, b.z);
  }
  return text;
}

Topology take_part(const Topology& topology, const VolumePart& part) {
  if (part.whole()) return topology;
  std::vector<const MaskLeaf*> all;
  topology.mask->getNodes(all);

  // The region's leaves, block after block.
  std::vector<std::pair<openvdb::Coord, const MaskLeaf*>> leaves;
  for (const MaskLeaf* leaf : all) {
    const openvdb::Coord& origin = leaf->origin();
    if (part.region && !in_region(topology.frame, *part.region, origin)) continue;
    leaves.emplace_back(
        openvdb::Coord(origin.x() >> kBlockLog2, origin.y() >> kBlockLog2, origin.z() >> kBlockLog2), leaf);
  }
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });

  // A block belongs to the shard that its first leaf falls to.
  auto mask = std::make_shared<openvdb::MaskTree>(false);
  std::size_t shard = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i == 0 || leaves[i].first != leaves[i - 1].first) {
      shard = i * static_cast<std::size_t>(part.shards) / leaves.size() + 1;
    }
    if (shard == static_cast<std::size_t>(part.shard)) mask->addLeaf(new MaskLeaf(*leaves[i].second));
  }
  return {topology.frame, mask};
}

std::uint64_t estimate_part_memory(std::uint64_t whole_memory, const GridFrame& frame,
                                   const VolumePart& part) {
  // A leaf of a topology takes a twentieth of what a leaf takes in all; a sixteenth is above that.
  constexpr std::uint64_t kTopologyShare = 16;
  if (part.whole()) return whole_memory;
  std::uint64_t values = whole_memory;
  if (part.region) {
    openvdb::CoordBBox voxels = frame.voxels_in(*part.region);
    voxels.max().offset(static_cast<int>(MaskLeaf::DIM));  // leaves reach over the region
    values = std::min(values, estimate_memory(voxels));
  }
  return whole_memory / kTopologyShare + values / static_cast<std::uint64_t>(part.shards);
}

}  // namespace solidnoise
