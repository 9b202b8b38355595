#include "solidnoise/volume/vdb/write_leaves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>
#include <tbb/parallel_pipeline.h>

namespace solidnoise {
namespace {

constexpr std::size_t kLeavesAtOnce = 128;  // of floats 256 KB
constexpr std::size_t kChunksInFlight = 16;

// OpenVDB looks for values of inactive voxels in each leaf and copies the others; where all are active, there
// is nothing to look for.
template <typename Leaf>
void write_leaf(std::ostream& stream, const Leaf& leaf, bool half) {
  const std::uint32_t compression = openvdb::io::getDataCompression(stream);
  const bool masked = (compression & openvdb::io::COMPRESS_ACTIVE_MASK) != 0;
  if (half || !masked || !leaf.isValueMaskOn()) return leaf.writeBuffers(stream, half);
  leaf.valueMask().save(stream);
  stream.put(openvdb::io::NO_MASK_OR_INACTIVE_VALS);
  openvdb::io::writeData(stream, leaf.buffer().data(), Leaf::SIZE, compression);
}

}  // namespace

template <typename Leaf>
void write_leaves(std::ostream& stream, std::span<const Leaf* const> leaves, const openvdb::GridBase& grid) {
  const bool half = grid.saveFloatAsHalf();
  std::size_t next = 0;
  const auto take = [&](tbb::flow_control& control) {
    const std::size_t first = next;
    if (first >= leaves.size()) control.stop();
    next += kLeavesAtOnce;
    return first;
  };
  const auto compress = [&](std::size_t first) {
    std::ostringstream chunk;
    chunk.copyfmt(stream);  // what OpenVDB knows of the stream: codec, background
    const std::size_t end = std::min(first + kLeavesAtOnce, leaves.size());
    for (std::size_t i = first; i < end; ++i) write_leaf(chunk, *leaves[i], half);
    return std::move(chunk).str();
  };
  const auto write = [&](const std::string& bytes) {
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  constexpr auto in_order = tbb::filter_mode::serial_in_order;
  tbb::parallel_pipeline(
      kChunksInFlight, tbb::make_filter<void, std::size_t>(in_order, take) &
                           tbb::make_filter<std::size_t, std::string>(tbb::filter_mode::parallel, compress) &
                           tbb::make_filter<std::string, void>(in_order, write));
}

template void write_leaves(std::ostream&, std::span<const openvdb::FloatTree::LeafNodeType* const>,
                           const openvdb::GridBase&);
template void write_leaves(std::ostream&, std::span<const openvdb::Vec3STree::LeafNodeType* const>,
                           const openvdb::GridBase&);

}  // namespace solidnoise
