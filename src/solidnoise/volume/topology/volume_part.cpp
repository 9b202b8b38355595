#include "solidnoise/volume/topology/volume_part.h"

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

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

namespace {

// The leaves of a block, [first, end) of all, and what they cost.
struct Block {
  std::size_t first = 0;
  std::size_t end = 0;
  double cost = 0.0;  // leaves that are not free
};

using PlacedLeaf = std::pair<openvdb::Coord, const MaskLeaf*>;

// A leaf that is free still has to be looked at.
constexpr double kCostOfFreeLeaf = 1.0 / 64.0;

double cost_of(std::span<const PlacedLeaf> leaves, const IsFree& is_free) {
  const auto all = static_cast<double>(leaves.size());
  if (!is_free) return all;
  openvdb::CoordBBox voxels;
  for (const PlacedLeaf& leaf : leaves) voxels.expand(leaf.second->getNodeBoundingBox());
  if (is_free(voxels)) return kCostOfFreeLeaf * all;
  double cost = 0.0;
  for (const PlacedLeaf& leaf : leaves) {
    cost += is_free(leaf.second->getNodeBoundingBox()) ? kCostOfFreeLeaf : 1.0;
  }
  return cost;
}

// Leaves that are one block after the other.
std::vector<Block> blocks_of(const std::vector<PlacedLeaf>& leaves, const IsFree& is_free) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i == 0 || leaves[i].first != leaves[i - 1].first) blocks.push_back({i, i});
    blocks.back().end = i + 1;
  }
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    Block& block = blocks[i];
    block.cost = cost_of(std::span(leaves).subspan(block.first, block.end - block.first), is_free);
  });
  return blocks;
}

}  // namespace

Topology take_part(const Topology& topology, const VolumePart& part, const IsFree& is_free) {
  if (part.whole()) return topology;
  std::vector<const MaskLeaf*> all;
  topology.mask->getNodes(all);

  // The region's leaves, block after block.
  std::vector<PlacedLeaf> leaves;
  for (const MaskLeaf* leaf : all) {
    const openvdb::Coord& origin = leaf->origin();
    if (part.region && !in_region(topology.frame, *part.region, origin)) continue;
    leaves.emplace_back(
        openvdb::Coord(origin.x() >> kBlockLog2, origin.y() >> kBlockLog2, origin.z() >> kBlockLog2), leaf);
  }
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });

  // A block belongs to the shard that its first leaf falls to.
  const std::vector<Block> blocks = blocks_of(leaves, part.shards > 1 ? is_free : IsFree());
  double total = 0.0;
  for (const Block& block : blocks) total += block.cost;
  auto mask = std::make_shared<openvdb::MaskTree>(false);
  double before = 0.0;
  for (const Block& block : blocks) {
    const int shard = static_cast<int>(before * part.shards / total) + 1;
    before += block.cost;
    if (shard != part.shard) continue;
    for (std::size_t i = block.first; i < block.end; ++i) mask->addLeaf(new MaskLeaf(*leaves[i].second));
  }
  return {topology.frame, mask};
}

std::uint64_t estimate_part_memory(std::uint64_t whole_memory, const GridFrame& frame, const VolumePart& part,
                                   int channels) {
  // A leaf of a topology takes a twentieth of what a leaf takes in all; a sixteenth is above that.
  constexpr std::uint64_t kTopologyShare = 16;
  if (part.whole()) return whole_memory;
  std::uint64_t values = whole_memory;
  if (part.region) {
    openvdb::CoordBBox voxels = frame.voxels_in(*part.region);
    voxels.max().offset(static_cast<int>(MaskLeaf::DIM));  // leaves reach over the region
    values = std::min(values, estimate_memory(voxels, channels));
  }
  return whole_memory / kTopologyShare + values / static_cast<std::uint64_t>(part.shards);
}

}  // namespace solidnoise
