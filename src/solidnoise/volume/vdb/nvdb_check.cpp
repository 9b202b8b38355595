#include "solidnoise/volume/vdb/nvdb_check.h"

#include <cstddef>
#include <cstdint>
#include <iostream>  // NanoVDB's validator writes there without including it
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridValidator.h>
#include <stdexcept>

namespace solidnoise {
namespace {

void require(bool fits, const char* what) {
  if (!fits) throw std::runtime_error(what);
}

// The nodes of a level stand one after the other, from a byte of the grid on.
struct Level {
  std::uint64_t begin = 0;
  std::uint64_t node_bytes = 1;
  std::uint64_t count = 0;

  // Whether one of them stands at a distance, which may be any, from a byte. Before the first is far behind
  // the last: unsigned numbers wrap around.
  bool has(std::uint64_t from, std::int64_t distance) const {
    const std::uint64_t inside = from + static_cast<std::uint64_t>(distance) - begin;
    return inside < node_bytes * count && inside % node_bytes == 0;
  }
};

template <typename Node>
Level level_of(std::span<const std::uint8_t> bytes, const nanovdb::TreeData<3>& tree) {
  constexpr auto kLevel = Node::LEVEL;
  const std::size_t tree_at = sizeof(nanovdb::GridData);
  const std::size_t room = bytes.size() - tree_at;
  const std::size_t count = tree.mNodeCount[kLevel];
  if (count == 0) return {};
  const std::uint64_t offset = tree.mNodeOffset[kLevel];
  require(offset >= sizeof(tree) && offset <= room && offset % NANOVDB_DATA_ALIGNMENT == 0 &&
              count <= (room - offset) / sizeof(Node),
          "its nodes do not fit in it");
  return {tree_at + offset, sizeof(Node), count};
}

// Every child of an inner node is one of the level below.
template <typename Node>
void check_children(std::span<const std::uint8_t> bytes, const Level& level, const Level& children) {
  for (std::uint64_t i = 0; i < level.count; ++i) {
    const std::uint64_t at = level.begin + i * level.node_bytes;
    const auto& data = *reinterpret_cast<const typename Node::DataType*>(bytes.data() + at);
    for (auto child = data.mChildMask.beginOn(); child; ++child) {
      require(children.has(at, data.mTable[*child].child), "a node of it points elsewhere");
    }
  }
}

template <typename Root>
void check_root(std::span<const std::uint8_t> bytes, const nanovdb::TreeData<3>& tree,
                const Level& children) {
  using Data = typename Root::DataType;
  const std::size_t tree_at = sizeof(nanovdb::GridData);
  const std::size_t room = bytes.size() - tree_at;
  const std::uint64_t offset = tree.mNodeOffset[3];
  require(offset >= sizeof(tree) && offset <= room && offset % NANOVDB_DATA_ALIGNMENT == 0 &&
              sizeof(Data) <= room - offset,
          "its root does not fit in it");
  const std::uint64_t at = tree_at + offset;
  const auto& data = *reinterpret_cast<const Data*>(bytes.data() + at);
  require(data.mTableSize <= (room - offset - sizeof(Data)) / sizeof(typename Data::Tile),
          "its root does not fit in it");
  for (std::uint32_t i = 0; i < data.mTableSize; ++i) {
    const auto* const tile = data.tile(i);
    require(!tile->isChild() || children.has(at, tile->child), "its root points elsewhere");
  }
}

}  // namespace

template <typename BuildType>
void check_nvdb_grid(std::span<const std::uint8_t> bytes) {
  using Grid = nanovdb::NanoGrid<BuildType>;
  using Root = nanovdb::NanoRoot<BuildType>;
  using Upper = nanovdb::NanoUpper<BuildType>;
  using Lower = nanovdb::NanoLower<BuildType>;
  require(bytes.size() >= sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>), "it ends too early");
  const auto& grid = *reinterpret_cast<const nanovdb::GridData*>(bytes.data());
  require(grid.mMagic == NANOVDB_MAGIC_NUMBER, "it is no NanoVDB grid");
  require(grid.mVersion.getMajor() == NANOVDB_MAJOR_VERSION_NUMBER, "it is of another version of NanoVDB");
  require(grid.mGridSize == bytes.size(), "its size is not what it says");
  require(grid.mBlindMetadataCount == 0, "it has data beside its voxels, which is not read");
  require((grid.mFlags & static_cast<std::uint32_t>(nanovdb::GridFlags::HasLongGridName)) == 0,
          "its name is beside its voxels, which is not read");
  require(grid.mGridName[nanovdb::GridData::MaxNameSize - 1] == '\0', "its name has no end");

  const auto& tree = *reinterpret_cast<const nanovdb::TreeData<3>*>(bytes.data() + sizeof(grid));
  const Level leaves = level_of<nanovdb::NanoLeaf<BuildType>>(bytes, tree);
  const Level lower = level_of<Lower>(bytes, tree);
  const Level upper = level_of<Upper>(bytes, tree);
  check_root<Root>(bytes, tree, upper);
  check_children<Upper>(bytes, upper, lower);
  check_children<Lower>(bytes, lower, leaves);

  const std::string fault =
      nanovdb::GridValidator<BuildType>::check(*reinterpret_cast<const Grid*>(bytes.data()));
  require(fault.empty(), fault.c_str());
}

template void check_nvdb_grid<float>(std::span<const std::uint8_t>);
template void check_nvdb_grid<nanovdb::Fp16>(std::span<const std::uint8_t>);
template void check_nvdb_grid<nanovdb::Fp8>(std::span<const std::uint8_t>);
template void check_nvdb_grid<nanovdb::Fp4>(std::span<const std::uint8_t>);
template void check_nvdb_grid<nanovdb::Vec3f>(std::span<const std::uint8_t>);

}  // namespace solidnoise
