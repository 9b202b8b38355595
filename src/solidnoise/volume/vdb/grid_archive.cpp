#include "solidnoise/volume/vdb/grid_archive.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>

namespace solidnoise {
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

}  // namespace

void GridArchive::write_grids(std::ostream& stream, Offsets offsets, const openvdb::GridCPtrVec& grids,
                              const openvdb::MetaMap& metadata) const {
  const bool seekable = offsets == Offsets::write;
  openvdb::io::setDataCompression(stream, compression());
  writeHeader(stream, seekable);
  metadata.writeMeta(stream);
  const auto count = static_cast<std::int32_t>(grids.size());
  stream.write(reinterpret_cast<const char*>(&count), sizeof count);

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
}

// Descriptor, metadata, transform, topology, values; then, where the stream can seek, the offsets are filled
// in.
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
  const openvdb::GridBase::Ptr noted = openvdb::ConstPtrCast<openvdb::GridBase>(grid.copyGrid());
  noted->addStatsMetadata();
  noted->insertMeta(
      openvdb::GridBase::META_FILE_COMPRESSION,
      openvdb::StringMetadata(openvdb::io::compressionToString(openvdb::io::getDataCompression(stream))));
  noted->removeMeta(openvdb::GridBase::META_FILE_DELAYED_LOAD);
  noted->writeMeta(stream);
  grid.writeTransform(stream);
  grid.writeTopology(stream);
  note(&Descriptor::setBlockPos);
  grid.writeBuffers(stream);
  note(&Descriptor::setEndPos);

  if (offsets == Offsets::none) return;
  stream.seekp(positions);
  descriptor.writeStreamPos(stream);
  descriptor.seekToEnd(stream);
}

}  // namespace solidnoise
