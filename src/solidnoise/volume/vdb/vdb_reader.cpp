#include "solidnoise/volume/vdb/vdb_reader.h"

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "solidnoise/volume/vdb/vdb_structure.h"

namespace solidnoise {

VdbReader::VdbReader(const std::filesystem::path& path, Progress* progress) : file_(path, progress) {
  openvdb::initialize();
  stream_.exceptions(std::ios::badbit | std::ios::failbit);
  if (!file_.is_open()) stream_.setstate(std::ios::failbit);
  stream_.seekg(0, std::ios::end);
  size_ = stream_.tellg();
  stream_.seekg(0);

  require_known_version();
  readHeader(stream_);
  // OpenVDB's functions look up version, compression and the like in the stream.
  stream_metadata_ = std::make_shared<openvdb::io::StreamMetadata>();
  stream_metadata_->setSeekable(true);
  openvdb::io::setStreamMetadataPtr(stream_, stream_metadata_, /*transfer=*/false);
  setFormatVersion(stream_);
  setLibraryVersion(stream_);
  setDataCompression(stream_);

  check_metadata();
  metadata_.readMeta(stream_);
  const std::int32_t count = readGridCount(stream_);
  for (std::int32_t i = 0; i < count; ++i) read_entry();
}

void VdbReader::require_known_version() {
  const auto start = stream_.tellg();
  std::int64_t magic = 0;
  stream_.read(reinterpret_cast<char*>(&magic), sizeof(magic));
  if (magic != openvdb::OPENVDB_MAGIC) throw std::runtime_error("it does not begin like one");
  const std::uint32_t version = walk().take_size();
  if (version < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) {
    throw std::runtime_error("it was written by an OpenVDB too old for this reader");
  }
  if (version > openvdb::OPENVDB_FILE_VERSION) {  // OpenVDB itself would print a warning and go on
    throw std::runtime_error("it was written by an OpenVDB newer than this reader");
  }
  stream_.seekg(start);
}

void VdbReader::read_entry() {
  check_descriptor();
  Entry entry;
  openvdb::GridBase::Ptr grid = entry.descriptor.read(stream_);
  if (inputHasGridOffsets()) {
    walk().require_in_file(entry.descriptor.getGridPos());
    walk().require_in_file(entry.descriptor.getBlockPos());
    walk().require_in_file(entry.descriptor.getEndPos());
    // Each grid is read at most once on the way, so that a file cannot lead in circles.
    if (entry.descriptor.getEndPos() < stream_.tellg()) throw std::runtime_error("offsets out of order");
    entry.descriptor.seekToEnd(stream_);
  } else {
    check_grid(entry.descriptor);
    readGrid(grid, entry.descriptor, stream_);
    entry.grid = grid;
  }
  entries_.push_back(std::move(entry));
}

std::string VdbReader::grid_name(std::size_t index) const {
  return entries_[index].descriptor.gridName();
}

openvdb::GridBase::Ptr VdbReader::read_header(std::size_t index) {
  const Entry& entry = entries_[index];
  if (entry.grid != nullptr) return entry.grid;
  entry.descriptor.seekToGrid(stream_);
  check_grid_header();
  return read_grid_header(entry.descriptor);
}

openvdb::GridBase::Ptr VdbReader::read_grid_header(const openvdb::io::GridDescriptor& descriptor) {
  openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(descriptor.gridType());
  grid->setSaveFloatAsHalf(descriptor.saveFloatAsHalf());
  readGridCompression(stream_);
  grid->readMeta(stream_);
  grid->readTransform(stream_);
  return grid;
}

openvdb::GridBase::Ptr VdbReader::read_grid(std::size_t index) {
  const openvdb::GridBase::Ptr grid = read_own(index);
  if (entries_[index].descriptor.isInstance()) grid->setTree(read_own(parent_of(index))->baseTreePtr());
  return grid;
}

openvdb::GridPtrVec VdbReader::read_grids() {
  openvdb::GridPtrVec grids;
  for (std::size_t i = 0; i < entries_.size(); ++i) grids.push_back(read_own(i));
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].descriptor.isInstance()) grids[i]->setTree(grids[parent_of(i)]->baseTreePtr());
  }
  return grids;
}

openvdb::GridBase::Ptr VdbReader::read_own(std::size_t index) {
  const Entry& entry = entries_[index];
  if (entry.grid != nullptr) return entry.grid;
  entry.descriptor.seekToGrid(stream_);
  check_grid(entry.descriptor);
  const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.descriptor.gridType());
  grid->setSaveFloatAsHalf(entry.descriptor.saveFloatAsHalf());
  readGrid(grid, entry.descriptor, stream_);
  if (stream_.tellg() != entry.descriptor.getEndPos()) throw std::runtime_error("a grid's size is wrong");
  return grid;
}

std::vector<VdbNode> VdbReader::find_nodes(std::size_t index) {
  const openvdb::io::GridDescriptor& descriptor = entries_[index].descriptor;
  descriptor.seekToGrid(stream_);
  return check_grid(descriptor);
}

namespace {

template <typename Tree>
using LowerNode = typename Tree::RootNodeType::ChildNodeType::ChildNodeType;

}  // namespace

template <typename Lower>
void VdbReader::read_topology(std::size_t index, const VdbNode& node, Lower& lower) {
  static const auto kBackground = openvdb::zeroVal<typename Lower::ValueType>();
  const openvdb::io::GridDescriptor& descriptor = entries_[index].descriptor;
  descriptor.seekToGrid(stream_);
  readGridCompression(stream_);
  openvdb::io::setGridBackgroundValuePtr(stream_, &kBackground);
  stream_.seekg(node.topology);
  lower.readTopology(stream_, descriptor.saveFloatAsHalf());
}

template <typename Tree>
void VdbReader::read_leaves(std::size_t index, const VdbNode& node, Tree& tree) {
  const auto background = openvdb::zeroVal<typename Tree::ValueType>();
  LowerNode<Tree> lower(openvdb::PartialCreate(), node.origin, background);
  read_topology(index, node, lower);
  stream_.seekg(node.values);
  lower.readBuffers(stream_, entries_[index].descriptor.saveFloatAsHalf());
  std::vector<typename Tree::LeafNodeType*> leaves;
  lower.stealNodes(leaves, background, false);
  for (auto* const leaf : leaves) tree.addLeaf(leaf);
}

template <typename Tree>
void VdbReader::read_masks(std::size_t index, const VdbNode& node, openvdb::MaskTree& mask) {
  LowerNode<Tree> lower(openvdb::PartialCreate(), node.origin, openvdb::zeroVal<typename Tree::ValueType>());
  read_topology(index, node, lower);
  for (auto leaf = lower.cbeginChildOn(); leaf; ++leaf) {
    auto voxels = std::make_unique<openvdb::MaskTree::LeafNodeType>(openvdb::PartialCreate(), leaf->origin());
    voxels->setValueMask(leaf->valueMask());
    mask.addLeaf(voxels.release());
  }
}

void VdbReader::read_values(std::size_t index, const VdbNode& node, openvdb::FloatTree& tree) {
  read_leaves(index, node, tree);
}

void VdbReader::read_values(std::size_t index, const VdbNode& node, openvdb::Vec3STree& tree) {
  read_leaves(index, node, tree);
}

void VdbReader::read_voxels(std::size_t index, const VdbNode& node, openvdb::MaskTree& mask) {
  const bool floats = entries_[index].descriptor.gridType() == openvdb::FloatGrid::gridType();
  floats ? read_masks<openvdb::FloatTree>(index, node, mask)
         : read_masks<openvdb::Vec3STree>(index, node, mask);
}

std::size_t VdbReader::parent_of(std::size_t index) const {
  for (std::size_t other = 0; other < entries_.size(); ++other) {
    const openvdb::io::GridDescriptor& parent = entries_[other].descriptor;
    if (parent.uniqueName() == entries_[index].descriptor.instanceParentName() && !parent.isInstance()) {
      return other;
    }
  }
  throw std::runtime_error("a grid shares the tree of one that is not there");
}

void VdbReader::check_metadata() {
  const auto start = stream_.tellg();
  walk().skip_metadata();
  stream_.seekg(start);
}

void VdbReader::check_descriptor() {
  const auto start = stream_.tellg();
  for (int i = 0; i < 3; ++i) walk().skip_string();  // name, type, name of the grid whose tree it shares
  stream_.seekg(start);
}

void VdbReader::check_grid_header() {
  const auto start = stream_.tellg();
  skim_grid_header();
  stream_.seekg(start);
}

std::vector<VdbNode> VdbReader::check_grid(const openvdb::io::GridDescriptor& descriptor) {
  const auto start = stream_.tellg();
  const std::uint32_t compression = skim_grid_header();
  std::vector<VdbNode> nodes;
  if (!descriptor.isInstance()) {
    // The transform has no size of its own: OpenVDB must read it to come to the tree.
    stream_.seekg(start);
    const openvdb::GridBase::Ptr header = read_grid_header(descriptor);
    // Its metadata say whether values are halves: OpenVDB goes by them, not by the descriptor.
    nodes = check_vdb_tree(stream_, size_, {descriptor.gridType(), header->saveFloatAsHalf(), compression});
    // OpenVDB looks for leaves' values where the descriptor says.
    const std::int64_t values = nodes.empty() ? 0 : nodes.front().values;
    if (inputHasGridOffsets() && values != 0 && values != descriptor.getBlockPos()) {
      throw std::runtime_error("a grid's values are not where it says");
    }
  }
  stream_.seekg(start);
  return nodes;
}

std::uint32_t VdbReader::skim_grid_header() {
  const std::uint32_t compression = walk().take_size();
  walk().skip_metadata();
  walk().skip_string();  // the transform's type
  return compression;
}

VdbHeaderWalk VdbReader::walk() {
  return {stream_, size_};
}

}  // namespace solidnoise
