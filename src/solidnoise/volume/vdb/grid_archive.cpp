#include "solidnoise/volume/vdb/grid_archive.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>
#include <tbb/parallel_pipeline.h>

#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

constexpr std::size_t kLeavesAtOnce = 128;  // of floats 256 KB
constexpr std::size_t kChunksInFlight = 16;

template <typename Grid>
class ParallelGrid final : public Grid {
 public:
  // OpenVDB has no shallow copy of a grid that is const; nothing of it is changed.
  explicit ParallelGrid(const Grid& grid)
      : Grid(const_cast<Grid&>(grid), openvdb::ShallowCopy()), half_(grid.saveFloatAsHalf()) {
    this->tree().getNodes(leaves_);
  }

  // The values of a tree are those of its leaves, in their order.
  void writeBuffers(std::ostream& stream) const override {
    std::size_t next = 0;
    const auto take = [&](tbb::flow_control& control) {
      const std::size_t first = next;
      if (first >= leaves_.size()) control.stop();
      next += kLeavesAtOnce;
      return first;
    };
    const auto compress = [&](std::size_t first) {
      std::ostringstream chunk;
      chunk.copyfmt(stream);  // what OpenVDB knows of the stream: codec, background
      const std::size_t end = std::min(first + kLeavesAtOnce, leaves_.size());
      for (std::size_t i = first; i < end; ++i) write_leaf(chunk, *leaves_[i]);
      return std::move(chunk).str();
    };
    const auto write = [&](const std::string& bytes) {
      stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    };
    constexpr auto in_order = tbb::filter_mode::serial_in_order;
    tbb::parallel_pipeline(kChunksInFlight, tbb::make_filter<void, std::size_t>(in_order, take) &
                                                tbb::make_filter<std::size_t, std::string>(
                                                    tbb::filter_mode::parallel, compress) &
                                                tbb::make_filter<std::string, void>(in_order, write));
  }

 private:
  using Leaf = typename Grid::TreeType::LeafNodeType;

  // OpenVDB looks for values of inactive voxels in each leaf and copies the others; where all are active,
  // there is nothing to look for.
  void write_leaf(std::ostream& stream, const Leaf& leaf) const {
    const std::uint32_t compression = openvdb::io::getDataCompression(stream);
    const bool masked = (compression & openvdb::io::COMPRESS_ACTIVE_MASK) != 0;
    if (half_ || !masked || !leaf.isValueMaskOn()) return leaf.writeBuffers(stream, half_);
    leaf.valueMask().save(stream);
    stream.put(openvdb::io::NO_MASK_OR_INACTIVE_VALS);
    openvdb::io::writeData(stream, leaf.buffer().data(), Leaf::SIZE, compression);
  }

  bool half_;
  std::vector<const Leaf*> leaves_;
};

}  // namespace

openvdb::GridBase::ConstPtr parallel_grid(const openvdb::GridBase::ConstPtr& grid) {
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

template <typename Number>
void write_number(std::ostream& stream, Number number) {
  stream.write(reinterpret_cast<const char*>(&number), sizeof number);
}

// As openvdb::io::Archive::writeHeader, but for the UUID, of version 8 (RFC 9562: the writer's own).
void write_header(std::ostream& stream, bool seekable, std::uint64_t identity) {
  write_number(stream, std::int64_t{openvdb::OPENVDB_MAGIC});
  write_number(stream, std::uint32_t{openvdb::OPENVDB_FILE_VERSION});
  write_number(stream, static_cast<std::uint32_t>(openvdb::OPENVDB_LIBRARY_MAJOR_VERSION));
  write_number(stream, static_cast<std::uint32_t>(openvdb::OPENVDB_LIBRARY_MINOR_VERSION));
  write_number(stream, static_cast<char>(seekable));
  const std::uint64_t more = mix_bits(identity + kGoldenGamma);
  stream << fmt::format("{:08x}-{:04x}-8{:03x}-a{:03x}-{:012x}", identity >> 32, identity >> 16 & 0xffff,
                        identity & 0xfff, more >> 52, more & 0xffffffffffff);
}

}  // namespace

void GridArchive::write_grids(std::ostream& stream, Offsets offsets, const Contents& contents) const {
  const bool seekable = offsets == Offsets::write;
  const openvdb::GridCPtrVec& grids = contents.grids;
  openvdb::io::setDataCompression(stream, compression());
  write_header(stream, seekable, contents.identity);
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
