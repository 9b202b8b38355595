#include "solidnoise/volume/vdb/grid_archive.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>

#include "solidnoise/core/random.h"
#include "solidnoise/volume/vdb/streamed_grid.h"
#include "solidnoise/volume/vdb/write_leaves.h"

namespace solidnoise {
namespace {

template <typename Grid>
class ParallelGrid final : public Grid {
 public:
  // OpenVDB has no shallow copy of a grid that is const; nothing of it is changed.
  explicit ParallelGrid(const Grid& grid) : Grid(const_cast<Grid&>(grid), openvdb::ShallowCopy()) {}

  // The values of a tree are those of its leaves, in their order.
  void writeBuffers(std::ostream& stream) const override {
    std::vector<const Leaf*> leaves;
    this->tree().getNodes(leaves);
    write_leaves<Leaf>(stream, leaves, *this);
  }

 private:
  using Leaf = typename Grid::TreeType::LeafNodeType;
};

}  // namespace

openvdb::GridBase::ConstPtr parallel_grid(const openvdb::GridBase::ConstPtr& grid) {
  if (dynamic_cast<const StreamedGrid*>(grid.get()) != nullptr) return grid;
  if (grid->isType<openvdb::FloatGrid>()) {
    return std::make_shared<ParallelGrid<openvdb::FloatGrid>>(static_cast<const openvdb::FloatGrid&>(*grid));
  }
  if (grid->isType<openvdb::Vec3SGrid>()) {
    return std::make_shared<ParallelGrid<openvdb::Vec3SGrid>>(static_cast<const openvdb::Vec3SGrid&>(*grid));
  }
  return grid;
}

namespace {

using openvdb::io::GridDescriptor;

// A grid's name in the file, unlike all before: those that occur more than once, and empty ones, are
// numbered.
std::string unique_name(const openvdb::GridCPtrVec& grids, const std::string& name,
                        std::set<std::string>& taken) {
  const auto same = [&](const openvdb::GridBase::ConstPtr& grid) { return grid->getName() == name; };
  const bool numbered = name.empty() || std::count_if(grids.begin(), grids.end(), same) > 1;
  std::string unique = numbered ? GridDescriptor::addSuffix(name, 0) : name;
  for (int number = 1; !taken.insert(unique).second; ++number)
    unique = GridDescriptor::addSuffix(name, number);
  return unique;
}

// As openvdb::io::Archive::writeHeader, but for the UUID.
void write_header(std::ostream& stream, bool seekable) {
  write_number(stream, std::int64_t{openvdb::OPENVDB_MAGIC});
  write_number(stream, std::uint32_t{openvdb::OPENVDB_FILE_VERSION});
  write_number(stream, static_cast<std::uint32_t>(openvdb::OPENVDB_LIBRARY_MAJOR_VERSION));
  write_number(stream, static_cast<std::uint32_t>(openvdb::OPENVDB_LIBRARY_MINOR_VERSION));
  write_number(stream, static_cast<char>(seekable));
}

// Of version 8 (RFC 9562: the writer's own).
void write_uuid(std::ostream& stream, std::uint64_t identity) {
  const std::uint64_t more = mix_bits(identity + kGoldenGamma);
  stream << fmt::format("{:08x}-{:04x}-8{:03x}-a{:03x}-{:012x}", identity >> 32, identity >> 16 & 0xffff,
                        identity & 0xfff, more >> 52, more & 0xffffffffffff);
}

}  // namespace

void GridArchive::write_grids(std::ostream& stream, Offsets offsets, const Contents& contents) const {
  const bool seekable = offsets == Offsets::write;
  const openvdb::GridCPtrVec& grids = contents.grids;
  openvdb::io::setDataCompression(stream, compression());
  write_header(stream, seekable);
  const std::ostream::pos_type identity = seekable ? stream.tellp() : std::streampos(0);
  write_uuid(stream, seekable ? 0 : contents.identity());
  contents.metadata.writeMeta(stream);
  write_number(stream, static_cast<std::int32_t>(grids.size()));

  std::set<std::string> taken;
  std::vector<GridDescriptor> written;
  for (const openvdb::GridBase::ConstPtr& grid : grids) {
    const std::string name = unique_name(grids, grid->getName(), taken);
    GridDescriptor descriptor(name, grid->type(), grid->saveFloatAsHalf());
    std::size_t parent = 0;
    while (parent < written.size() && (&grids[parent]->constBaseTree() != &grid->constBaseTree() ||
                                       grids[parent]->saveFloatAsHalf() != grid->saveFloatAsHalf())) {
      ++parent;
    }
    // What the writers of values ask for. The stream points at the pointer.
    auto of_grid = std::make_shared<openvdb::io::StreamMetadata>(stream);
    of_grid->setHalfFloat(grid->saveFloatAsHalf());
    of_grid->gridMetadata() = *grid;
    openvdb::io::setStreamMetadataPtr(stream, of_grid, false);
    if (parent < written.size()) {
      descriptor.setInstanceParentName(written[parent].uniqueName());
      writeGridInstance(descriptor, grid, stream, seekable);
    } else {
      write_grid(stream, offsets, *grid, descriptor);
    }
    written.push_back(descriptor);
    openvdb::io::clearStreamMetadataPtr(stream);
    openvdb::io::setDataCompression(stream, compression());  // which may differ from grid to grid
  }
  if (!seekable) return;
  stream.seekp(identity);
  write_uuid(stream, contents.identity());
  stream.seekp(0, std::ios::end);
}

// As the file has them: with statistics of the voxels.
openvdb::MetaMap GridArchive::metadata_of(std::ostream& stream, const openvdb::GridBase& grid) const {
  const openvdb::GridBase::Ptr noted = openvdb::ConstPtrCast<openvdb::GridBase>(grid.copyGrid());
  noted->addStatsMetadata();
  noted->insertMeta(
      openvdb::GridBase::META_FILE_COMPRESSION,
      openvdb::StringMetadata(openvdb::io::compressionToString(openvdb::io::getDataCompression(stream))));
  noted->removeMeta(openvdb::GridBase::META_FILE_DELAYED_LOAD);
  return *noted;
}

// Descriptor, metadata, transform, topology, values; then, where the stream can seek, the offsets are filled
// in, and the metadata that came to be with the values.
void GridArchive::write_grid(std::ostream& stream, Offsets offsets, const openvdb::GridBase& grid,
                             Descriptor& descriptor) const {
  const auto note = [&](void (Descriptor::*set)(std::int64_t)) {
    if (offsets == Offsets::write) (descriptor.*set)(stream.tellp());
  };
  descriptor.writeHeader(stream);
  const std::ostream::pos_type positions = offsets == Offsets::write ? stream.tellp() : std::streampos(0);
  descriptor.writeStreamPos(stream);
  note(&Descriptor::setGridPos);

  setGridCompression(stream, grid);
  const openvdb::MetaMap before = grid;
  const std::ostream::pos_type metadata = offsets == Offsets::write ? stream.tellp() : std::streampos(0);
  metadata_of(stream, grid).writeMeta(stream);
  const std::ostream::pos_type transform = offsets == Offsets::write ? stream.tellp() : std::streampos(0);
  grid.writeTransform(stream);
  grid.writeTopology(stream);
  note(&Descriptor::setBlockPos);
  grid.writeBuffers(stream);
  note(&Descriptor::setEndPos);

  if (offsets == Offsets::none) return;
  stream.seekp(positions);
  descriptor.writeStreamPos(stream);
  if (static_cast<const openvdb::MetaMap&>(grid) != before) {
    stream.seekp(metadata);
    metadata_of(stream, grid).writeMeta(stream);
    if (stream.tellp() != transform) throw std::logic_error("metadata have grown while values were written");
  }
  descriptor.seekToEnd(stream);
}

}  // namespace solidnoise
