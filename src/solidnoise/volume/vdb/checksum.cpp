#include "solidnoise/volume/vdb/checksum.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/core/random.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/streamed_grid.h"

namespace solidnoise {
namespace {

// Of where the voxels are.
Hash hash_frame(const openvdb::GridBase& grid, std::uint64_t leaves) {
  Hash hash;
  const openvdb::Mat4d matrix = grid.transform().baseMap()->isLinear()
                                    ? grid.transform().baseMap()->getAffineMap()->getMat4()
                                    : openvdb::Mat4d::identity();
  hash.add_bytes(matrix.asPointer(), 16 * sizeof(double));
  hash.add(grid.activeVoxelCount());
  hash.add(leaves);
  return hash;
}

template <typename Grid>
std::uint64_t checksum_of(const Grid& grid) {
  std::vector<const typename Grid::TreeType::LeafNodeType*> leaves;
  grid.tree().getNodes(leaves);
  GridChecksum<Grid> sum(grid, leaves.size());
  sum.add(leaves);
  return sum.finish(grid);
}

}  // namespace

void Hash::add(std::uint64_t bits) {
  bits_ = mix_bits(bits_ ^ bits) + kGoldenGamma;
}

void Hash::add(const openvdb::Coord& voxel) {
  for (int axis = 0; axis < 3; ++axis) add(static_cast<std::uint64_t>(voxel[axis]));
}

void Hash::add_bytes(const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  for (; size > 0; from += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(size, sizeof word);
    std::memcpy(&word, from, count);
    add(word);
    size -= count;
  }
}

template <typename Grid>
GridChecksum<Grid>::GridChecksum(const openvdb::GridBase& grid, std::uint64_t leaves)
    : hash_(hash_frame(grid, leaves)) {}

template <typename Grid>
void GridChecksum<Grid>::add(std::span<const Leaf* const> leaves) {
  std::vector<std::uint64_t> parts(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    Hash part;
    part.add(leaves[i]->origin());
    const auto& mask = leaves[i]->valueMask();
    for (openvdb::Index word = 0; word < mask.WORD_COUNT; ++word) {
      part.add(mask.template getWord<std::uint64_t>(word));
    }
    part.add_bytes(leaves[i]->buffer().data(), Leaf::SIZE * sizeof(typename Grid::ValueType));
    parts[i] = part.bits();
  });
  for (const std::uint64_t part : parts) hash_.add(part);
}

template <typename Grid>
std::uint64_t GridChecksum<Grid>::finish(const Grid& grid) const {
  Hash hash = hash_;
  auto tile = grid.tree().cbeginValueAll();
  tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const typename Grid::ValueType value = *tile;
    if (!tile.isValueOn() && value == grid.background()) continue;
    hash.add(tile.getCoord());
    hash.add(tile.getVoxelCount() * 2 + (tile.isValueOn() ? 1 : 0));
    hash.add_bytes(&value, sizeof value);
  }
  hash.add_bytes(&grid.background(), sizeof grid.background());
  return hash.bits();
}

template class GridChecksum<openvdb::FloatGrid>;
template class GridChecksum<openvdb::Vec3SGrid>;

std::uint64_t checksum(const openvdb::GridBase& grid) {
  if (const auto* streamed = dynamic_cast<const StreamedGrid*>(&grid)) return streamed->written_checksum();
  std::uint64_t sum = 0;
  using Hashed = openvdb::TypeList<openvdb::FloatGrid, openvdb::Vec3SGrid>;
  const bool known = grid.apply<Hashed>([&](const auto& typed) { sum = checksum_of(typed); });
  return known ? sum : hash_frame(grid, grid.baseTree().leafCount()).bits();
}

}  // namespace solidnoise
