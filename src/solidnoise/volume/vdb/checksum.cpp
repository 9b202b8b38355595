#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/core/random.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

class Hash {
 public:
  void add(std::uint64_t bits) { bits_ = mix_bits(bits_ ^ bits) + kGoldenGamma; }
  void add(const openvdb::Coord& voxel) {
    for (int axis = 0; axis < 3; ++axis) add(static_cast<std::uint64_t>(voxel[axis]));
  }
  void add_bytes(const void* bytes, std::size_t size) {
    const char* from = static_cast<const char*>(bytes);
    for (; size > 0; from += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      const std::size_t count = std::min(size, sizeof word);
      std::memcpy(&word, from, count);
      add(word);
      size -= count;
    }
  }
  std::uint64_t bits() const { return bits_; }

 private:
  std::uint64_t bits_ = 0;
};

template <typename Grid>
void add_values(const Grid& grid, Hash& hash) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  using Value = typename Grid::ValueType;
  std::vector<const Leaf*> leaves;
  grid.tree().getNodes(leaves);
  std::vector<std::uint64_t> parts(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    Hash part;
    part.add(leaves[i]->origin());
    const auto& mask = leaves[i]->valueMask();
    for (openvdb::Index word = 0; word < mask.WORD_COUNT; ++word) {
      part.add(mask.template getWord<std::uint64_t>(word));
    }
    part.add_bytes(leaves[i]->buffer().data(), Leaf::SIZE * sizeof(Value));
    parts[i] = part.bits();
  });
  for (const std::uint64_t part : parts) hash.add(part);
  auto tile = grid.tree().cbeginValueAll();
  tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const Value value = *tile;
    if (!tile.isValueOn() && value == grid.background()) continue;
    hash.add(tile.getCoord());
    hash.add(tile.getVoxelCount() * 2 + (tile.isValueOn() ? 1 : 0));
    hash.add_bytes(&value, sizeof value);
  }
  hash.add_bytes(&grid.background(), sizeof(Value));
}

}  // namespace

std::uint64_t checksum(const openvdb::GridBase& grid) {
  Hash hash;
  const openvdb::Mat4d matrix = grid.transform().baseMap()->isLinear()
                                    ? grid.transform().baseMap()->getAffineMap()->getMat4()
                                    : openvdb::Mat4d::identity();
  hash.add_bytes(matrix.asPointer(), 16 * sizeof(double));
  hash.add(grid.activeVoxelCount());
  hash.add(grid.baseTree().leafCount());
  using Hashed = openvdb::TypeList<openvdb::FloatGrid, openvdb::Vec3SGrid>;
  grid.apply<Hashed>([&](const auto& typed) { add_values(typed, hash); });
  return hash.bits();
}

}  // namespace solidnoise
