#include "solidnoise/volume/vdb/parallel_grid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <openvdb/io/Compression.h>
#include <tbb/parallel_pipeline.h>

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

}  // namespace solidnoise
